#include "candela/target/literals.h"

#include <utf8.h>

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "valid_utf8.h"

namespace candela::target {

namespace {

// clang-format off
// From U+00C0 on.
constexpr std::array k_latin = std::to_array<std::string_view>({
    "A", "A", "A", "A", "Ae", "Aa", "AE", "C", "E", "E", "E", "E", "I", "I", "I", "I", "D", "N", "O", "O",
    "O", "O", "Oe", "x", "O", "U", "U", "U", "Ue", "Y", "Th", "ss", "a", "a", "a", "a", "ae", "aa", "ae",
    "c", "e", "e", "e", "e", "i", "i", "i", "i", "d", "n", "o", "o", "o", "o", "oe", "_", "o", "u", "u",
    "u", "ue", "y", "th", "y", "A", "a", "A", "a", "A", "a", "C", "c", "C", "c", "C", "c", "C", "c", "D",
    "d", "D", "d", "E", "e", "E", "e", "E", "e", "E", "e", "E", "e", "G", "g", "G", "g", "G", "g", "G", "g",
    "H", "h", "H", "h", "I", "i", "I", "i", "I", "i", "I", "i", "I", "i", "IJ", "ij", "J", "j", "K", "k",
    "k", "L", "l", "L", "l", "L", "l", "L", "l", "L", "l", "N", "n", "N", "n", "N", "n", "n", "Ng", "ng",
    "O", "o", "O", "o", "O", "o", "OE", "oe", "R", "r", "R", "r", "R", "r", "S", "s", "S", "s", "S", "s",
    "S", "s", "T", "t", "T", "t", "T", "t", "U", "u", "U", "u", "U", "u", "U", "u", "U", "u", "U", "u", "W",
    "w", "Y", "y", "Y", "Z", "z", "Z", "z", "Z", "z", "s",
});
// clang-format on

/// In ASCII; '_' for characters other than letters and a few marks.
std::string ascii_of(char32_t c) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
        (c < 0x80 && std::string_view(" -_.,:()").find(static_cast<char>(c)) != std::string_view::npos);
    if (is_plain) return {static_cast<char>(c)};
    constexpr char32_t k_first_latin = 0xc0;
    if (c >= k_first_latin && c - k_first_latin < k_latin.size())
        return std::string(k_latin[c - k_first_latin]);
    return "_";
}

}  // namespace

std::string ascii_identifier(std::string_view name) {
    constexpr std::size_t k_longest = 100;
    const bool is_quoted = name.size() > 2 && name.front() == '\'' && name.back() == '\'';
    if (is_quoted) name = name.substr(1, name.size() - 2);
    const std::string text = valid_utf8(name);
    std::string result;
    for (auto at = text.begin(); at != text.end() && result.size() < k_longest;)
        result += ascii_of(utf8::unchecked::next(at));
    return result.substr(0, k_longest);
}

}  // namespace candela::target
