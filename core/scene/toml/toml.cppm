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
#include <utility>
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

    const Entry* find(std::string_view key) const;
    Entry* find(std::string_view key);
};

using ArrayNode = std::vector<Node>;

/// TOML has dates and times; scenes do not.
struct DateNode {};

struct Node {
    SourceLocation place;
    std::variant<bool, std::int64_t, double, std::string, DateNode, ArrayNode, TableNode> value;

    const TableNode* table() const { return std::get_if<TableNode>(&value); }
    TableNode* table() { return std::get_if<TableNode>(&value); }
    const ArrayNode* array() const { return std::get_if<ArrayNode>(&value); }
    ArrayNode* array() { return std::get_if<ArrayNode>(&value); }
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

/// Any value, on one line.
CANDELA_EXPORT std::string toml_text(const Node& node);

/// A part of a text, and its replacement.
struct TextEdit {
    std::size_t begin = 0, end = 0;  // bytes
    std::string text;
};

/// The text that a document was parsed from, for editing.
class CANDELA_EXPORT SourceText {
  public:
    explicit SourceText(std::string text);

    const std::string& text() const noexcept { return text_; }
    /// "\r\n" if there is one, else "\n".
    std::string_view line_break() const noexcept { return line_break_; }
    /// The offset of a line and a column, which count from 1, in characters.
    std::size_t offset_of(const SourceLocation& place) const;

  private:
    std::string text_;
    std::string_view line_break_;
    std::vector<std::size_t> line_begins_;
};

/// Whether a table has its own header or braces, instead of being made by dotted keys in the lines of
/// another.
CANDELA_EXPORT bool has_lines_of_its_own(const SourceText& text, const Node& table);

CANDELA_EXPORT TextEdit replacement(const SourceText& text, const Node& value, const std::string& by);

/// Keys, which may be dotted, and values as TOML.
using Entries = std::vector<std::pair<std::string, std::string>>;

/// Adds entries after the last one of a table, or of the document, which has no header.
CANDELA_EXPORT TextEdit insertion(const SourceText& text, const TableNode& table,
                                  const SourceLocation* header, const Entries& entries);

/// Adds a table at the end.
CANDELA_EXPORT TextEdit new_table(const SourceText& text, const std::string& name, const Entries& entries);

/// Applies edits; those at one offset in their order. Throws Error (bad_request) if two overlap.
CANDELA_EXPORT std::string edited(std::string_view text, const std::vector<TextEdit>& edits);

}  // namespace candela
