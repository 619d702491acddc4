// TOML as a tree of plain values, each with its place in its file.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

export module candela.toml;

import candela.diagnostics;

export namespace candela {

struct Node;

/// Entries in the order in which they stand in the file; no key twice.
struct TableNode {
    struct Entry;
    std::vector<Entry> entries;

    const Entry* find(std::string_view key) const;
    Entry* find(std::string_view key);
};

using ArrayNode = std::vector<Node>;

/// TOML has dates and times; no scene does.
struct DateNode {};

struct Node {
    SourcePlace place;
    std::variant<bool, std::int64_t, double, std::string, DateNode, ArrayNode, TableNode> value;

    const TableNode* table() const { return std::get_if<TableNode>(&value); }
    TableNode* table() { return std::get_if<TableNode>(&value); }
    const ArrayNode* array() const { return std::get_if<ArrayNode>(&value); }
    ArrayNode* array() { return std::get_if<ArrayNode>(&value); }
};

struct TableNode::Entry {
    std::string key;
    SourcePlace key_place;
    Node node;
};

/// What a value is, to a person: `a string, "red"`, "the number 0.5", "a table".
CANDELA_API std::string description(const Node& node);

/// What the files of one scene may be together: far more than anybody writes, but a wrong file named by
/// mistake may be anything, and a tree of values takes a hundred times a text's memory.
struct ReadingLimits {
    std::uintmax_t bytes = k_most_bytes;
    std::size_t values = k_most_values;

    static constexpr std::uintmax_t k_most_bytes = 64u << 20;
    static constexpr std::size_t k_most_values = 5'000'000;  // counted by their separators
};

/// Reads and parses a file. Reports what is wrong (R11: each way of not being readable has its own message)
/// and returns nothing then. `shown_name` is how the file is called in diagnostics. A file beyond `left` is
/// refused; else what it holds is taken off.
CANDELA_API std::optional<TableNode> read_document(const std::filesystem::path& file,
                                                   const std::string& shown_name, ReadingLimits& left,
                                                   Diagnostics& diagnostics);

/// "did you mean 'scene.toml'?", from what lies where `missing` does not; or empty.
CANDELA_API std::string file_suggestion(const std::filesystem::path& missing);

/// Parses a text.
CANDELA_API std::optional<TableNode> parse_document(std::string_view text, const std::string& shown_name,
                                                    Diagnostics& diagnostics);

/// A value as it stands after a `=`; bare words are strings. Reports what is wrong, at `place`.
CANDELA_API std::optional<Node> parse_value(std::string_view text, const SourcePlace& place,
                                            Diagnostics& diagnostics);

/// Values as TOML says them: a text in double quotes, with escapes (throws Error where it is not UTF-8); a
/// number in as few digits as read back as the same number (throws Error where it is not finite); a key, in
/// quotes if need be.
CANDELA_API std::string toml_text(std::string_view text);
CANDELA_API std::string toml_text(double x);
CANDELA_API std::string toml_text(float x);
CANDELA_API std::string toml_key(std::string_view key);

}  // namespace candela
