// Converts JSON to text and back. The library's reader and writer are compiled once, here, instead of in
// every file that uses them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Members keep the order in which they were added.
using Json = nlohmann::ordered_json;

/// The same JSON, with the characters that candela::printable() escapes as JSON escapes: they can only occur
/// in its strings.
std::string printable_json(std::string_view json);

/// On one line, or on several lines with `indentation` spaces per level. Safe for a terminal: bytes that are
/// not UTF-8, as in file names or other programs' messages, become U+FFFD, and characters are escaped as by
/// printable_json().
std::string json_text(const Json& json, int indentation = -1);

/// Throws nlohmann::json::parse_error.
Json parse_json(std::string_view text);

/// Discarded (Json::is_discarded()) if `text` is not JSON.
Json json_or_discarded(std::string_view text);
