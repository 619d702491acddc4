module;

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <new>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>
#include "tomlplusplus.h"

module candela.scene;

import :text;
import candela.util;

namespace candela {

namespace {

namespace fs = std::filesystem;

SourceLocation place_of(const toml::source_region& region, const std::string& file) {
    SourceLocation place{file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 0};
    if (region.end.line == region.begin.line && region.end.column > region.begin.column) {
        place.length = static_cast<int>(region.end.column - region.begin.column);
    }
    return place;
}

Node plain(const toml::node& node, const std::string& file);

TableNode plain_table(const toml::table& table, const std::string& file) {
    TableNode result;
    for (const auto& [key, value] : table) {
        result.entries.push_back({std::string(key.str()), place_of(key.source(), file), plain(value, file)});
    }
    // toml++ sorts by key; people read from top to bottom.
    std::ranges::sort(result.entries, [](const auto& a, const auto& b) {
        return std::pair(a.key_place.line, a.key_place.column) <
               std::pair(b.key_place.line, b.key_place.column);
    });
    return result;
}

Node plain(const toml::node& node, const std::string& file) {
    Node result;
    result.place = place_of(node.source(), file);
    if (const auto* table = node.as_table()) {
        result.value = plain_table(*table, file);
    } else if (const auto* array = node.as_array()) {
        ArrayNode elements;
        for (const toml::node& element : *array) elements.push_back(plain(element, file));
        result.value = std::move(elements);
    } else if (const auto* boolean = node.as_boolean()) {
        result.value = boolean->get();
    } else if (const auto* integer = node.as_integer()) {
        result.value = integer->get();
    } else if (const auto* real = node.as_floating_point()) {
        result.value = real->get();
    } else if (const auto* text = node.as_string()) {
        result.value = text->get();
    } else {
        result.value = DateNode{};
    }
    return result;
}

std::string_view line_of(std::string_view text, int number) {
    for (; number > 1 && !text.empty(); --number) {
        const std::size_t end = text.find('\n');
        text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    }
    text = text.substr(0, text.find('\n'));
    if (text.ends_with('\r')) text.remove_suffix(1);
    return text;
}

/// toml++ reads numbers through a stream, which swallows bad_alloc; then it reports that 2.6 is not a number.
bool is_out_of_memory(std::string_view description) {
    constexpr std::string_view k_complaint = "' could not be interpreted as a value";
    const std::size_t end = description.find(k_complaint);
    const std::size_t quote = end == std::string_view::npos ? end : description.rfind('\'', end - 1);
    if (quote == std::string_view::npos) return false;
    const std::string_view word = description.substr(quote + 1, end - quote - 1);
    double number = 0;
    const auto [last, problem] = std::from_chars(word.data(), word.data() + word.size(), number);
    return problem == std::errc() && last == word.data() + word.size();
}

void report(const toml::parse_error& problem, std::string_view text, const std::string& shown_name,
            Diagnostics& diagnostics) {
    SourceLocation place = place_of(problem.source(), shown_name);
    if (is_out_of_memory(problem.description())) throw std::bad_alloc();
    const std::string_view line = line_of(text, place.line);
    // At the end of the file toml++ counts the last line ending as a character.
    place.column = std::min(place.column, 1 + static_cast<int>(character_count(line)));
    SyntaxProblem said = syntax_problem(problem.description(), line, place.column);
    diagnostics.error(std::move(place), std::move(said.message), std::move(said.hint));
}

/// Whether toml++ can parse the text safely; reports if not.
bool can_be_parsed(std::string_view text, const std::string& shown_name, std::size_t& values_left,
                   Diagnostics& diagnostics) {
    if (const auto invalid = first_invalid_byte(text)) {
        diagnostics.error(place_at(text, *invalid, shown_name), "this is not UTF-8 text",
                          "save the file as UTF-8");
        return false;
    }
    const auto excess = first_excess(text, values_left);
    if (!excess) return true;
    const SourceLocation place = place_at(text, excess->offset, shown_name);
    // It may be too deep only because an earlier bracket was not closed.
    constexpr std::size_t k_worth_parsing = 1u << 20;
    try {
        if (excess->offset < k_worth_parsing) {
            static_cast<void>(toml::parse(text.substr(0, excess->offset), shown_name));
        }
    } catch (const toml::parse_error& problem) {
        const auto& begin = problem.source().begin;
        if (std::pair(static_cast<int>(begin.line), static_cast<int>(begin.column)) <
            std::pair(place.line, place.column)) {
            report(problem, text, shown_name, diagnostics);
            return false;
        }
    }
    diagnostics.error(place, excess->message, "scenes never need that");
    return false;
}

}  // namespace

const TableNode::Entry* TableNode::find(std::string_view key) const {
    for (const Entry& entry : entries) {
        if (entry.key == key) return &entry;
    }
    return nullptr;
}

TableNode::Entry* TableNode::find(std::string_view key) {
    return const_cast<Entry*>(std::as_const(*this).find(key));
}

std::string description(const Node& node) {
    struct Describer {
        std::string operator()(bool b) const { return b ? "true" : "false"; }
        std::string operator()(std::int64_t i) const { return fmt::format("the integer {}", i); }
        std::string operator()(double d) const {
            return fmt::format("the number {}", std::isfinite(d) ? toml_text(d) : fmt::format("{}", d));
        }
        std::string operator()(const std::string& s) const {
            return fmt::format("a string, \"{}\"", shortened(s));
        }
        std::string operator()(const DateNode&) const { return "a date or time"; }
        std::string operator()(const ArrayNode& a) const {
            return a.size() == 1 ? "a list of 1 value" : fmt::format("a list of {} values", a.size());
        }
        std::string operator()(const TableNode&) const { return "a table"; }
    };
    return std::visit(Describer{}, node.value);
}

namespace {

std::optional<TableNode> parse(std::string_view text, const std::string& shown_name, std::size_t& values_left,
                               Diagnostics& diagnostics) {
    diagnostics.remember_source(shown_name, std::string(text));
    if (!can_be_parsed(text, shown_name, values_left, diagnostics)) return std::nullopt;
    try {
        return plain_table(toml::parse(text, shown_name), shown_name);
    } catch (const toml::parse_error& problem) {
        report(problem, text, shown_name, diagnostics);
        return std::nullopt;
    }
}

}  // namespace

std::optional<TableNode> parse_document(std::string_view text, const std::string& shown_name,
                                        Diagnostics& diagnostics) {
    std::size_t values_left = ReadingLimits::k_most_values;
    return parse(text, shown_name, values_left, diagnostics);
}

std::optional<TableNode> read_document(const fs::path& file, const std::string& shown_name,
                                       ReadingLimits& left, Diagnostics& diagnostics) {
    const auto text = text_of_file(file, shown_name, left.bytes, diagnostics);
    if (!text) return std::nullopt;
    return parse(*text, shown_name, left.values, diagnostics);
}

std::optional<TableNode> read_document(std::string bytes, const std::string& shown_name, ReadingLimits& left,
                                       Diagnostics& diagnostics) {
    const auto text = text_of_bytes(std::move(bytes), shown_name, left.bytes, diagnostics);
    if (!text) return std::nullopt;
    return parse(*text, shown_name, left.values, diagnostics);
}

std::string as_written(const Node& node, const Diagnostics& diagnostics) {
    if (node.place.line < 1 || node.place.length < 1) return {};
    const auto line = diagnostics.source_line(node.place);
    if (!line) return {};
    std::string_view rest = *line;
    const auto skip = [&](int characters) {
        std::size_t size = 0;
        for (int i = 0; i < characters; ++i) size += first_character(rest.substr(size)).size();
        const std::string_view skipped = rest.substr(0, size);
        rest.remove_prefix(size);
        return skipped;
    };
    skip(node.place.column - 1);
    return std::string(skip(node.place.length));
}

std::optional<Node> parse_value(std::string_view text, const SourceLocation& place,
                                Diagnostics& diagnostics) {
    Node result;
    result.place = place;
    const bool is_bare_word = !text.empty() &&
                              std::ranges::all_of(text,
                                                  [](unsigned char c) {
                                                      return std::isalnum(c) || c == '-' || c == '_' ||
                                                             c == '.' || c == '/' || c >= 0x80;
                                                  }) &&
                              !std::isdigit(static_cast<unsigned char>(text[0])) && text[0] != '-' &&
                              text != "true" && text != "false" && text != "nan" && text != "inf";
    if (is_bare_word) {
        result.value = std::string(text);
        return result;
    }
    const auto refuse = [&](const std::string& why) {
        diagnostics.error(place, fmt::format("'{}' is not a value: {}", shortened(text), why),
                          "write a number, [three, of, them], true, false or a string");
        return std::nullopt;
    };
    const std::string line = fmt::format("value = {}", text);
    if (first_invalid_byte(line)) return refuse("it is not UTF-8 text");
    std::size_t values_left = ReadingLimits::k_most_values;
    if (const auto excess = first_excess(line, values_left)) return refuse(excess->message);
    try {
        const toml::table table = toml::parse(line);
        const toml::node* const value = table.get("value");
        if (table.size() != 1 || value == nullptr) {
            diagnostics.error(place, fmt::format("'{}' is not one value", shortened(text)));
            return std::nullopt;
        }
        result = plain(*value, place.file);
        result.place = place;
        return result;
    } catch (const toml::parse_error& problem) {
        const auto& begin = problem.source().begin;
        return refuse(syntax_problem(problem.description(), line_of(line, static_cast<int>(begin.line)),
                                     static_cast<int>(begin.column))
                          .message);
    }
}

}  // namespace candela
