#include "candela/target/literals.h"

#include <utf8.h>

#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>

#include "valid_utf8.h"

namespace candela::target {

namespace {

// clang-format off
// From U+00C0 on: Latin.
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

// From U+0391 on: Greek, according to ISO 843 type 2.
constexpr std::array k_greek = std::to_array<std::string_view>({
    "A", "B", "G", "D", "E", "Z", "I", "Th", "I", "K", "L", "M", "N", "X", "O", "P", "R", "_", "S", "T",
    "Y", "F", "Ch", "Ps", "O", "I", "Y", "a", "e", "i", "i", "y", "a", "b", "g", "d", "e", "z", "i", "th",
    "i", "k", "l", "m", "n", "x", "o", "p", "r", "s", "s", "t", "y", "f", "ch", "ps", "o", "i", "y", "o",
    "y", "o",
});

// From U+0410 on: Cyrillic, transliterated as in English.
constexpr std::array k_cyrillic = std::to_array<std::string_view>({
    "A", "B", "V", "G", "D", "E", "Zh", "Z", "I", "J", "K", "L", "M", "N", "O", "P", "R", "S", "T", "U",
    "F", "Kh", "Ts", "Ch", "Sh", "Shch", "_", "Y", "_", "E", "Yu", "Ya", "a", "b", "v", "g", "d", "e", "zh",
    "z", "i", "j", "k", "l", "m", "n", "o", "p", "r", "s", "t", "u", "f", "kh", "ts", "ch", "sh", "shch",
    "_", "y", "_", "e", "yu", "ya",
});
// clang-format on

struct Alphabet {
    char32_t first;
    std::span<const std::string_view> letters;
};
constexpr Alphabet k_alphabets[] = {{0xc0, k_latin}, {0x391, k_greek}, {0x410, k_cyrillic}};

/// In ASCII; '_' for characters other than letters and a few marks.
std::string tame_character(char32_t c) {
    const bool is_plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') ||
        (c < 0x80 && std::string_view(" -_.,:()").find(static_cast<char>(c)) != std::string_view::npos);
    if (is_plain) return {static_cast<char>(c)};
    for (const Alphabet& alphabet : k_alphabets) {
        if (c >= alphabet.first && c - alphabet.first < alphabet.letters.size())
            return std::string(alphabet.letters[c - alphabet.first]);
    }
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
        result += tame_character(utf8::unchecked::next(at));
    return result.substr(0, k_longest);
}

}  // namespace candela::target
