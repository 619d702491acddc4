// The files of a scene as one document.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

export module candela.scene:document;

import :request;
import :toml;
import candela.util;

export namespace candela {

/// The contents of the files, the includes and the settings combined.
struct MergedDocument {
    SourceLocation place;                      // of the first file
    TableNode root;                            // as if everything were in one file, with `include` resolved
    std::vector<std::filesystem::path> files;  // absolute
};

/// A setting's path, split at its dots; "quoted parts" may contain dots.
CANDELA_EXPORT std::vector<std::string> parts_of(std::string_view path);

/// The lights and objects of a document by name or index, found at a cost that does not grow with their
/// number.
class CANDELA_EXPORT ElementIndex {
  public:
    explicit ElementIndex(const TableNode& root);

    /// The index of the one with that name, or with that index from 0; nothing if there is none. `kind`:
    /// "light" or "object".
    std::optional<std::size_t> find(std::string_view kind, const std::string& which) const;

  private:
    struct Kind {
        std::size_t count = 0;
        std::unordered_map<std::string, std::size_t> first_named{};
    };
    Kind lights_, objects_;
};

/// Reads and merges the files, and applies the settings. Reports all problems; returns nothing if a file
/// cannot be read as TOML.
CANDELA_EXPORT std::optional<MergedDocument> merge_documents(const SceneRequest& request,
                                                             Diagnostics& diagnostics);

}  // namespace candela
