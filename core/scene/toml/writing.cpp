module;

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

module candela.toml;

import candela.diagnostics;

namespace candela {

namespace {

/// The number of bytes of the character at the start of `text`; nothing if it is not UTF-8 (Unicode 15, table
/// 3-7).
std::optional<std::size_t> character_size(std::string_view text) {
    const auto byte = [&](std::size_t i) {
        return i < text.size() ? static_cast<unsigned>(static_cast<unsigned char>(text[i])) : 0u;
    };
    const unsigned first = byte(0);
    if (first < 0x80) return 1;
    const std::size_t size = first >= 0xc2 && first <= 0xdf   ? 2
                             : first >= 0xe0 && first <= 0xef ? 3
                             : first >= 0xf0 && first <= 0xf4 ? 4
                                                              : 0;
    if (size == 0) return std::nullopt;
    // No overlong forms, no surrogates, nothing beyond U+10FFFF.
    const unsigned low = first == 0xe0 ? 0xa0 : first == 0xf0 ? 0x90 : 0x80;
    const unsigned high = first == 0xed ? 0x9f : first == 0xf4 ? 0x8f : 0xbf;
    if (byte(1) < low || byte(1) > high) return std::nullopt;
    for (std::size_t i = 2; i < size; ++i) {
        if (byte(i) < 0x80 || byte(i) > 0xbf) return std::nullopt;
    }
    return size;
}

std::string escaped(char c) {
    switch (c) {
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
            const auto code = static_cast<unsigned char>(c);
            return code < 0x20 || code == 0x7f ? fmt::format("\\u{:04X}", code) : std::string(1, c);
        }
    }
}

/// 2 would be an integer.
std::string as_real(std::string digits) {
    return digits.find_first_of(".e") == std::string::npos ? digits + ".0" : digits;
}

void require_finite(double x) {
    if (!std::isfinite(x)) throw Error(ExitCode::failure, fmt::format("{} has no place in a scene file", x));
}

}  // namespace

std::string toml_text(std::string_view text) {
    std::string result = "\"";
    while (!text.empty()) {
        const auto size = character_size(text);
        if (!size) throw Error(ExitCode::failure, fmt::format("'{}' is not UTF-8, as TOML is", text));
        result += *size == 1 ? escaped(text[0]) : std::string(text.substr(0, *size));
        text.remove_prefix(*size);
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
