module;

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

module candela.scene:merge;

import :request;
import :toml;
import candela.util;

namespace candela {

/// The contents of the files, the includes and the settings combined.
struct MergedDocument {
    SourceLocation place;                      // of the first file
    TableNode root;                            // as if everything were in one file, with `include` resolved
    std::vector<std::filesystem::path> files;  // absolute
};

/// A setting's path, split at its dots; "quoted parts" may contain dots.
std::vector<std::string> parts_of(std::string_view path);

/// The index of the light or object with that name, or with that index from 0; nothing if there is none.
std::optional<std::size_t> index_of(const ArrayNode& all, const std::string& which);

/// index_of() for all lights and objects of a document, at a cost that does not grow with their number.
class ElementIndex {
  public:
    explicit ElementIndex(const TableNode& root);

    /// `kind`: "light" or "object".
    std::optional<std::size_t> find(std::string_view kind, const std::string& which) const;

  private:
    struct Kind {
        std::size_t count = 0;
        std::unordered_map<std::string, std::size_t> first_named{};
    };
    Kind lights_, objects_;
};

/// Sets the value at a setting's path. Returns false if the path leads nowhere, which is reported at `place`;
/// `place` also becomes the key's position. `index`: that of `root`, for many calls.
bool set_value(TableNode& root, std::string_view path, Node value, const SourceLocation& place,
               Diagnostics& diagnostics, const ElementIndex* index = nullptr);

/// Like the above, for a path that parts_of() has split.
bool set_value(TableNode& root, std::vector<std::string> parts, Node value, const SourceLocation& place,
               Diagnostics& diagnostics, const ElementIndex* index = nullptr);

std::optional<MergedDocument> merge_documents(const SceneRequest& request, Diagnostics& diagnostics);

}  // namespace candela
