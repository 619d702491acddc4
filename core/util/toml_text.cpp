module;

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>

module candela.util;

import :diagnostics;
import :text;

namespace candela {

namespace {

std::string escaped(std::string_view character) {
    switch (character[0]) {
        case '"':
            return "\\\"";
        case '\\':
            return "\\\\";
        case '\b':
            return "\\b";
        case '\t':
            return "\\t";
        case '\n':
            return "\\n";
        case '\f':
            return "\\f";
        case '\r':
            return "\\r";
        default: {
            const auto hidden = hidden_code_point(character);
            if (!hidden) return std::string(character);
            const auto code = static_cast<std::uint32_t>(*hidden);
            return code < 0x10000 ? fmt::format("\\u{:04X}", code) : fmt::format("\\U{:08X}", code);
        }
    }
}

/// Adds ".0": 2 would be an integer.
std::string as_real(std::string digits) {
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

void require_finite(double x) {
    if (!std::isfinite(x))
        throw Error(ErrorCategory::failure, fmt::format("{} cannot be written in a scene file", x));
}

}  // namespace

std::string toml_text(std::string_view text) {
    if (const auto invalid = first_invalid_byte(text)) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' is not UTF-8, which TOML requires", text.substr(*invalid)));
    }
    std::string result = "\"";
    while (!text.empty()) {
        const std::string_view character = first_character(text);
        result += escaped(character);
        text.remove_prefix(character.size());
    }
    return result + '"';
}

std::string toml_text(double x) {
    require_finite(x);
    return as_real(fmt::format("{}", x));
}

std::string toml_text(float x) {
    require_finite(static_cast<double>(x));
    const std::string digits = fmt::format("{}", x);
    // TOML's numbers are doubles: in rare cases, rounding twice yields the float's neighbour.
    double read = 0;
    std::from_chars(digits.data(), digits.data() + digits.size(), read);
    return static_cast<float>(read) == x ? as_real(digits) : toml_text(static_cast<double>(x));
}

std::string toml_key(std::string_view key) {
    const bool is_bare = !key.empty() && std::ranges::all_of(key, [](unsigned char c) {
        return c < 0x80 && (std::isalnum(c) != 0 || c == '_' || c == '-');
    });
    return is_bare ? std::string(key) : toml_text(key);
}

}  // namespace candela
