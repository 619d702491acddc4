#include "json/json.h"

#include <fmt/format.h>

#include <cstdint>
#include <iterator>
#include <optional>

import candela.util;

std::string printable_json(std::string_view json) {
    std::string result;
    result.reserve(json.size());
    while (!json.empty()) {
        const std::string_view character = candela::first_character(json);
        json.remove_prefix(character.size());
        const auto hidden = character == "\n" ? std::nullopt : candela::hidden_code_point(character);
        if (!hidden && character.size() == 1 && static_cast<unsigned char>(character[0]) >= 0x80) {
            result += "\\ufffd";
        } else if (!hidden) {
            result += character;
        } else if (*hidden < 0x10000) {
            fmt::format_to(std::back_inserter(result), "\\u{:04x}", static_cast<std::uint32_t>(*hidden));
        } else {
            // JSON escapes UTF-16 code units.
            const auto bits = static_cast<std::uint32_t>(*hidden) - 0x10000;
            fmt::format_to(std::back_inserter(result), "\\u{:04x}\\u{:04x}", 0xd800 + (bits >> 10),
                           0xdc00 + (bits & 0x3ff));
        }
    }
    return result;
}

std::string json_text(const Json& json, int indentation) {
    return printable_json(json.dump(indentation, ' ', false, Json::error_handler_t::replace));
}

Json parse_json(std::string_view text) { return Json::parse(text); }

Json json_or_discarded(std::string_view text) { return Json::parse(text, nullptr, false); }
