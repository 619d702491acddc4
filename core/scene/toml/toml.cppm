// TOML as a tree of plain values, each with its position in its file.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

export module candela.scene:toml;

import candela.util;

export namespace candela {

struct Node;

/// Entries in file order; keys are unique.
struct TableNode {
    struct Entry;
    std::vector<Entry> entries;

    CANDELA_EXPORT const Entry* find(std::string_view key) const;
    CANDELA_EXPORT Entry* find(std::string_view key);
};

using ArrayNode = std::vector<Node>;

/// TOML has dates and times; scenes do not.
struct DateNode {};

struct Node {
    SourceLocation place;
    std::variant<bool, std::int64_t, double, std::string, DateNode, ArrayNode, TableNode> value;

    inline const TableNode* table() const { return std::get_if<TableNode>(&value); }
    inline TableNode* table() { return std::get_if<TableNode>(&value); }
    inline const ArrayNode* array() const { return std::get_if<ArrayNode>(&value); }
    inline ArrayNode* array() { return std::get_if<ArrayNode>(&value); }
};

struct TableNode::Entry {
    std::string key;
    SourceLocation key_place;
    Node node;
};

/// A value described for people: `a string, "red"`, "the number 0.5", "a table".
CANDELA_EXPORT std::string description(const Node& node);

/// Limits on the files of one scene together: far more than anybody writes, but a file named by mistake may
/// be anything, and a tree of values takes a hundred times the memory of its text.
struct ReadingLimits {
    std::uintmax_t bytes = k_most_bytes;
    std::size_t values = k_most_values;

    static constexpr std::uintmax_t k_most_bytes = 64u << 20;
    static constexpr std::size_t k_most_values = 5'000'000;  // counted by their separators
};

/// Reads and parses a file. Reports problems (R11: each way of being unreadable has its own message) and then
/// returns nothing. `shown_name` is the file's name in diagnostics. A file that exceeds `left` is refused;
/// otherwise its size is subtracted.
CANDELA_EXPORT std::optional<TableNode> read_document(const std::filesystem::path& file,
                                                      const std::string& shown_name, ReadingLimits& left,
                                                      Diagnostics& diagnostics);

/// Like the above, for bytes that did not come from a file but, for example, a pipe.
CANDELA_EXPORT std::optional<TableNode> read_document(std::string bytes, const std::string& shown_name,
                                                      ReadingLimits& left, Diagnostics& diagnostics);

/// A value that is on one line, as its author wrote it: "255.0", "1e3"; empty if its text is not available.
CANDELA_EXPORT std::string as_written(const Node& node, const Diagnostics& diagnostics);

/// "did you mean 'scene.toml'?", from the names of files in the folder of `missing`; or empty.
CANDELA_EXPORT std::string file_suggestion(const std::filesystem::path& missing);

CANDELA_EXPORT std::optional<TableNode> parse_document(std::string_view text, const std::string& shown_name,
                                                       Diagnostics& diagnostics);

/// Parses a value as written after a `=`; bare words are strings. Reports problems at `place`.
CANDELA_EXPORT std::optional<Node> parse_value(std::string_view text, const SourceLocation& place,
                                               Diagnostics& diagnostics);

}  // namespace candela
