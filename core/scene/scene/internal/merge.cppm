module;

#include <optional>

module candela.scene:merge;

import :request;
import candela.diagnostics;
import candela.toml;

namespace candela {

/// The contents of the files, the includes and the settings combined.
struct MergedDocument {
    SourcePlace place;  // of the first file
    TableNode root;     // as if everything were in one file, `include` followed
};

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
