module;

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
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

/// A setting's path, split at its dots; "quoted parts" may contain dots.
std::vector<std::string> parts_of(std::string_view path);

/// The index of the light or object with that name, or with that index from 0; nothing if there is none.
std::optional<std::size_t> index_of(const ArrayNode& all, const std::string& which);

/// Sets the value at a setting's path; false if the path leads nowhere, which is reported at `place`, and
/// that is where the key will be said to stand.
bool set_value(TableNode& root, std::string_view path, Node value, const SourcePlace& place,
               Diagnostics& diagnostics);

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
