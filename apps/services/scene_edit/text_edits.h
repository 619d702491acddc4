// Changes of a document's text that leave everything else as it is.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

import candela.scene;
import candela.util;

namespace candela {

/// Any value, on one line.
std::string toml_text(const Node& node);

/// A part of a text, and its replacement.
struct TextEdit {
    std::size_t begin = 0, end = 0;  // bytes
    std::string text;
};

/// The text that a document was parsed from, for editing.
class SourceText {
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
bool has_lines_of_its_own(const SourceText& text, const Node& table);

TextEdit replacement(const SourceText& text, const Node& value, const std::string& by);

/// Keys, which may be dotted, and values as TOML.
using Entries = std::vector<std::pair<std::string, std::string>>;

/// Adds entries after the last one of a table, or of the document, which has no header.
TextEdit insertion(const SourceText& text, const TableNode& table, const SourceLocation* header,
                   const Entries& entries);

/// Adds a table at the end.
TextEdit new_table(const SourceText& text, const std::string& name, const Entries& entries);

/// Applies edits; those at one offset in their order. Throws Error (bad_request) if two overlap.
std::string edited(std::string_view text, const std::vector<TextEdit>& edits);

}  // namespace candela
