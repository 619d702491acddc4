module;

#include <fmt/format.h>

#include <toml++/toml.h>
#include <algorithm>
#include <cctype>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

module candela.document;

import candela.diagnostics;

namespace candela {

namespace {

namespace fs = std::filesystem;

/// Larger than any scene that somebody wrote; a wrong file named by mistake may be anything.
constexpr std::uintmax_t k_largest_file = 64u << 20;

SourcePlace place_of(const toml::source_region& region, const std::string& file) {
    SourcePlace place{file, static_cast<int>(region.begin.line), static_cast<int>(region.begin.column), 0};
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

std::string shortened(std::string text) {
    constexpr std::size_t k_longest = 40;
    if (text.size() > k_longest) text = text.substr(0, k_longest) + "...";
    for (char& c : text) {
        if (static_cast<unsigned char>(c) < 0x20) c = ' ';
    }
    return text;
}

/// Says why a file cannot be read, or returns its text.
std::optional<std::string> text_of_file(const fs::path& file, const std::string& shown_name,
                                        Diagnostics& diagnostics) {
    const SourcePlace place{shown_name, 0, 0, 0};
    const auto fail = [&](const std::string& message, const std::string& hint = {}) {
        diagnostics.failure(place, message, hint);
        return std::nullopt;
    };
    const auto no_scene = [&](const std::string& message) {
        diagnostics.error(place, message);
        return std::nullopt;
    };
    std::error_code problem;
    const fs::file_status status = fs::status(file, problem);
    if (status.type() == fs::file_type::not_found)
        return fail("there is no such file", file_suggestion(file));
    if (status.type() == fs::file_type::none)
        return fail(fmt::format("it cannot be looked at: {}", problem.message()));
    if (status.type() == fs::file_type::directory) return fail("this is a directory; a scene is a file");
    if (status.type() != fs::file_type::regular)
        return fail("this is no ordinary file (a pipe or a device?)");
    const std::uintmax_t size = fs::file_size(file, problem);
    if (!problem && size > k_largest_file) {
        return fail(
            fmt::format("the file is too large: {} bytes, where a scene may have {}", size, k_largest_file));
    }
    std::ifstream in(file, std::ios::binary);
    if (!in) return fail(fmt::format("the file cannot be opened: {}", std::strerror(errno)));
    std::string text{std::istreambuf_iterator<char>(in), {}};
    if (in.bad()) return fail(fmt::format("the file cannot be read: {}", std::strerror(errno)));
    if (text.find_first_not_of(" \t\r\n") == std::string::npos) return no_scene("the file is empty");
    if (text.find('\0') != std::string::npos)
        return no_scene("this is a binary file; a scene is text (TOML)");
    return text;
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
        std::string operator()(std::int64_t i) const { return fmt::format("the whole number {}", i); }
        std::string operator()(double d) const { return fmt::format("the number {}", d); }
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

std::optional<TableNode> parse_document(std::string_view text, const std::string& shown_name,
                                        Diagnostics& diagnostics) {
    diagnostics.remember_source(shown_name, std::string(text));
    try {
        return plain_table(toml::parse(text, shown_name), shown_name);
    } catch (const toml::parse_error& problem) {
        diagnostics.error(place_of(problem.source(), shown_name), std::string(problem.description()));
        return std::nullopt;
    }
}

std::optional<TableNode> read_document(const fs::path& file, const std::string& shown_name,
                                       Diagnostics& diagnostics) {
    const auto text = text_of_file(file, shown_name, diagnostics);
    if (!text) return std::nullopt;
    return parse_document(*text, shown_name, diagnostics);
}

std::optional<Node> parse_value(std::string_view text, const SourcePlace& place, Diagnostics& diagnostics) {
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
    try {
        const toml::table table = toml::parse(fmt::format("value = {}\n", text));
        const toml::node* const value = table.get("value");
        if (table.size() != 1 || value == nullptr) {
            diagnostics.error(place, fmt::format("'{}' is not one value", shortened(std::string(text))));
            return std::nullopt;
        }
        result = plain(*value, place.file);
        result.place = place;
        return result;
    } catch (const toml::parse_error& problem) {
        diagnostics.error(
            place, fmt::format("'{}' is no value: {}", shortened(std::string(text)), problem.description()),
            "write a number, [three, of, them], true, false or a text");
        return std::nullopt;
    }
}

}  // namespace candela
