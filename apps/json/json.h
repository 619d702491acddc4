// JSON as text, and back. The library's reader and writer are compiled once, here, not by every file that
// uses them.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <string_view>

/// Members are in the order in which they were added.
using Json = nlohmann::ordered_json;

/// On one line, or on many with so many spaces for each depth. Fit for a terminal: bytes that are no UTF-8,
/// which a file's name or another program's messages may have, are U+FFFD, and characters as
/// candela::printable_json() has them.
std::string json_text(const Json& json, int indentation = -1);

/// Throws nlohmann::json::parse_error.
Json parse_json(std::string_view text);

/// Discarded (Json::is_discarded()) where `text` is no JSON.
Json json_or_discarded(std::string_view text);
