module;

#include <filesystem>
#include <optional>
#include <vector>

module candela.scene:merge;

import :request;
import candela.diagnostics;
import candela.toml;

namespace candela {

/// The contents of the files, the includes and the settings combined.
struct MergedDocument {
    SourcePlace place;                         // of the first file
    TableNode root;                            // as if everything were in one file, `include` followed
    std::vector<std::filesystem::path> files;  // absolute
};

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
