module;

#include <optional>

module candela.scene:merge;

import :request;
import candela.diagnostics;
import candela.toml;

namespace candela {

/// What the files, the includes and the settings say together.
struct MergedDocument {
    SourcePlace place;  // of the first file
    TableNode root;     // as if all stood in one file, `include` followed
};

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
