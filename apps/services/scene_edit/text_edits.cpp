#include "scene_edit/text_edits.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

import candela.scene;
import candela.util;

namespace candela {

namespace {

char character_at(const SourceText& source, const SourceLocation& place) {
    const std::size_t at = source.offset_of(place);
    return at < source.text().size() ? source.text()[at] : '\0';
}

/// The end of the string that begins with the quote at `begin`.
std::size_t end_of_string(std::string_view text, std::size_t begin) {
    const char quote = text[begin];
    const std::string_view three = text.substr(begin, 3);
    const bool is_long = three == std::string(3, quote);
    const std::string_view mark = is_long ? three : text.substr(begin, 1);
    for (std::size_t at = begin + mark.size(); at < text.size(); ++at) {
        if (text[at] == '\\' && quote == '"') {
            ++at;
        } else if (text.substr(at).starts_with(mark)) {
            at += mark.size();
            // A long string may end in two more quotes, which are part of it.
            for (int i = 0; is_long && i < 2 && at < text.size() && text[at] == quote; ++i) ++at;
            return at;
        }
    }
    return text.size();
}

/// The end of the value that begins at `begin`.
std::size_t end_of_value(std::string_view text, std::size_t begin) {
    int depth = 0;
    std::size_t at = begin;
    while (at < text.size()) {
        const char c = text[at];
        if (c == '"' || c == '\'') {
            at = end_of_string(text, at);
            if (depth == 0) return at;
            continue;
        }
        if (depth == 0 && std::string_view(",]}#\r\n").find(c) != std::string_view::npos) break;
        if (c == '#') {
            at = std::min(text.find('\n', at), text.size());
            continue;
        }
        if (c == '[' || c == '{') ++depth;
        if ((c == ']' || c == '}') && --depth == 0) return at + 1;
        ++at;
    }
    while (at > begin && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
    return at;
}

std::size_t end_of_line(std::string_view text, std::size_t at) {
    const std::size_t end = std::min(text.find('\n', at), text.size());
    return end > at && text[end - 1] == '\r' ? end - 1 : end;
}

bool is_array_of_tables(const SourceText& text, const Node& node) {
    const ArrayNode* const array = node.array();
    return array != nullptr && !array->empty() && array->front().table() != nullptr &&
           character_at(text, array->front().place) == '[';
}

struct LastEntry {
    std::size_t begin = 0, end = 0;  // from its key to its value's end
};

/// The last entry written in a table's own lines, and not under its own header.
LastEntry last_entry(const SourceText& text, const TableNode& table) {
    LastEntry last;
    for (const TableNode::Entry& entry : table.entries) {
        LastEntry found{text.offset_of(entry.key_place), 0};
        const TableNode* const inner = entry.node.table();
        if (inner != nullptr && character_at(text, entry.node.place) == '[') continue;
        if (is_array_of_tables(text, entry.node)) continue;
        if (inner != nullptr && character_at(text, entry.node.place) != '{') {
            found = last_entry(text, *inner);
        } else {
            found.end = end_of_value(text.text(), text.offset_of(entry.node.place));
        }
        if (found.end > last.end) last = found;
    }
    return last;
}

std::string_view indentation_at(std::string_view text, std::size_t at) {
    const std::size_t before = text.substr(0, at).rfind('\n');
    const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
    const std::string_view line = text.substr(begin, at - begin);
    return line.substr(0, std::min(line.find_first_not_of(" \t"), line.size()));
}

std::string joined(const Entries& entries, std::string_view separator) {
    std::string text;
    for (const auto& [key, value] : entries)
        text += fmt::format("{}{} = {}", text.empty() ? "" : separator, key, value);
    return text;
}

TextEdit insertion_into_braces(std::string_view text, std::size_t begin, const Entries& entries) {
    std::size_t at = end_of_value(text, begin) - 1;
    while (at > begin + 1 && (text[at - 1] == ' ' || text[at - 1] == '\t')) --at;
    const bool is_empty = at == begin + 1;
    return {at, at, (is_empty ? "" : ", ") + joined(entries, ", ")};
}

/// Does not count as a column of the first line.
constexpr std::string_view k_byte_order_mark = "\xef\xbb\xbf";

}  // namespace

SourceText::SourceText(std::string text)
    : text_(std::move(text)),
      line_break_(text_.find("\r\n") != std::string::npos ? "\r\n" : "\n"),
      line_begins_{text_.starts_with(k_byte_order_mark) ? k_byte_order_mark.size() : 0} {
    for (std::size_t at = text_.find('\n'); at != std::string::npos; at = text_.find('\n', at + 1))
        line_begins_.push_back(at + 1);
}

std::size_t SourceText::offset_of(const SourceLocation& place) const {
    const auto line = static_cast<std::size_t>(std::max(place.line, 1) - 1);
    std::size_t at = line < line_begins_.size() ? line_begins_[line] : text_.size();
    const std::string_view text = text_;
    for (int column = 1; column < place.column; ++column) at += first_character(text.substr(at)).size();
    return at;
}

bool has_lines_of_its_own(const SourceText& text, const Node& table) {
    const char first = character_at(text, table.place);
    return first == '[' || first == '{';
}

TextEdit replacement(const SourceText& text, const Node& value, const std::string& by) {
    const std::size_t begin = text.offset_of(value.place);
    return {begin, end_of_value(text.text(), begin), by};
}

TextEdit insertion(const SourceText& source, const TableNode& table, const SourceLocation* header,
                   const Entries& entries) {
    const std::string_view text = source.text();
    if (header != nullptr && character_at(source, *header) == '{')
        return insertion_into_braces(text, source.offset_of(*header), entries);
    const std::string line_break(source.line_break());
    const LastEntry last = last_entry(source, table);
    if (last.end == 0 && header == nullptr) {
        const std::size_t begin = source.offset_of({});
        return {begin, begin, joined(entries, line_break) + line_break};
    }
    const std::size_t line_end = end_of_line(text, last.end > 0 ? last.end : source.offset_of(*header));
    const std::string before =
        line_break + std::string(indentation_at(text, last.end > 0 ? last.begin : line_end));
    return {line_end, line_end, before + joined(entries, before)};
}

TextEdit new_table(const SourceText& source, const std::string& name, const Entries& entries) {
    const std::string& text = source.text();
    const std::string line_break(source.line_break());
    const std::string before = text.empty() || text.ends_with('\n') ? "" : line_break;
    return {text.size(), text.size(),
            fmt::format("{0}{1}[{2}]{1}{3}{1}", before, line_break, name, joined(entries, line_break))};
}

std::string edited(std::string_view text, const std::vector<TextEdit>& edits) {
    std::multimap<std::size_t, const TextEdit*> in_order;
    for (const TextEdit& edit : edits) in_order.emplace(edit.begin, &edit);
    std::string result;
    std::size_t at = 0;
    for (const auto& [begin, edit] : in_order) {
        if (begin < at) throw Error(ErrorCategory::bad_request, "one change is within another");
        result += text.substr(at, begin - at);
        result += edit->text;
        at = edit->end;
    }
    return result.append(text.substr(at));
}

std::string toml_text(const Node& node) {
    struct Writer {
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::int64_t i) const { return fmt::to_string(i); }
        std::string operator()(double d) const { return toml_text(d); }
        std::string operator()(const std::string& s) const { return toml_text(std::string_view(s)); }
        std::string operator()(const DateNode&) const {
            throw Error(ErrorCategory::bad_request, "scenes have no dates or times");
        }
        std::string operator()(const ArrayNode& array) const {
            std::string text;
            for (const Node& node : array) text += (text.empty() ? "" : ", ") + toml_text(node);
            return "[" + text + "]";
        }
        std::string operator()(const TableNode& table) const {
            std::string text;
            for (const TableNode::Entry& entry : table.entries)
                text += fmt::format("{}{} = {}", text.empty() ? "" : ", ", toml_key(entry.key),
                                    toml_text(entry.node));
            return "{" + text + "}";
        }
    };
    return std::visit(Writer{}, node.value);
}

}  // namespace candela
