#include "candela/target/literals.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "valid_utf8.h"

namespace candela::target {

namespace {

constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string replace_all(std::string text, std::string_view from, std::string_view to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
    return text;
}

}  // namespace

std::string float_text(float x) {
    std::string text = fmt::format("{}", x);
    if (text.find_first_of(".e") == std::string::npos) text += ".0";
    return text + "f";
}

std::string vec3_text(Vec3 v) {
    if (v.x == v.y && v.y == v.z) return fmt::format("vec3({})", float_text(v.x));
    return fmt::format("vec3({}, {}, {})", float_text(v.x), float_text(v.y), float_text(v.z));
}

std::array<Vec3, 3> columns_of(const ParamValue& runtime) {
    const float* const m = runtime.number;
    return {{{m[0], m[3], m[6]}, {m[1], m[4], m[7]}, {m[2], m[5], m[8]}}};
}

std::string member_text(const ParamSpec& parameter, const ParamValue& runtime) {
    switch (parameter.type) {
        case ParamType::real:
            return float_text(runtime.number[0]);
        case ParamType::choice:
            return fmt::format(
                "{} /* {} */", runtime.integer,
                ascii_identifier(parameter.choices[static_cast<std::size_t>(runtime.integer)]));
        case ParamType::integer:
        case ParamType::boolean:
            return fmt::format("{}", runtime.integer);
        case ParamType::matrix: {
            const auto columns = columns_of(runtime);
            return fmt::format("mat3({}, {}, {})", vec3_text(columns[0]), vec3_text(columns[1]),
                               vec3_text(columns[2]));
        }
        case ParamType::file:
        case ParamType::numbers:
            return fmt::format("Table{{{}, {}}}", runtime.integer, runtime.list.size());
        default:
            return vec3_text({runtime.number[0], runtime.number[1], runtime.number[2]});
    }
}

double shortest(float x) {
    return std::isfinite(x) ? std::stod(fmt::format("{}", x)) : static_cast<double>(x);
}

std::string identifier(std::string_view name, std::string_view suffix) {
    std::string result = fmt::format("{}_{}", name, suffix);
    std::ranges::replace(result, '-', '_');
    return result;
}

std::string html_text(std::string_view text) {
    std::string result = replace_all(valid_utf8(text), "&", "&amp;");
    result = replace_all(result, "<", "&lt;");
    result = replace_all(result, ">", "&gt;");
    return replace_all(replace_all(result, "\"", "&quot;"), "'", "&#39;");
}

std::string script_json(std::string json) { return replace_all(std::move(json), "<", "\\u003c"); }

void append_base64(std::span<const std::byte> bytes, std::string& text) {
    // Two digits at a time, twelve bits each.
    static const std::array<std::array<char, 2>, 4096> pairs = [] {
        std::array<std::array<char, 2>, 4096> result{};
        for (std::size_t i = 0; i < result.size(); ++i) result[i] = {k_digits[i >> 6], k_digits[i & 63u]};
        return result;
    }();
    const std::size_t begin = text.size(), whole = bytes.size() / 3 * 3, rest = bytes.size() - whole;
    text.resize(begin + (bytes.size() + 2) / 3 * 4, '=');
    char* to = text.data() + begin;
    const auto group_at = [&](std::size_t i, std::size_t count) {
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (k < count ? std::to_integer<std::uint32_t>(bytes[i + k]) : 0u);
        return group;
    };
    for (std::size_t i = 0; i < whole; i += 3, to += 4) {
        const std::uint32_t group = group_at(i, 3);
        std::memcpy(to, pairs[group >> 12].data(), 2);
        std::memcpy(to + 2, pairs[group & 4095u].data(), 2);
    }
    if (rest == 0) return;
    const std::uint32_t group = group_at(whole, rest);
    std::memcpy(to, pairs[group >> 12].data(), 2);
    if (rest == 2) to[2] = k_digits[group >> 6 & 63u];
}

std::string base64(std::span<const std::byte> bytes) {
    std::string text;
    append_base64(bytes, text);
    return text;
}

std::string base64_decoded(std::string_view text) {
    std::string bytes;
    std::uint32_t group = 0;
    int bits = 0;
    for (const char c : text) {
        if (c == '=') break;
        const std::size_t digit = k_digits.find(c);
        if (digit == std::string_view::npos) throw std::invalid_argument("malformed base64");
        group = group << 6 | static_cast<std::uint32_t>(digit);
        bits += 6;
        if (bits < 8) continue;
        bits -= 8;
        bytes += static_cast<char>(group >> bits & 255u);
    }
    return bytes;
}

}  // namespace candela::target
