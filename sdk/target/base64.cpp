#include "candela/target/base64.h"

#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

namespace candela::target {

namespace {

constexpr std::string_view k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

}  // namespace

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
