module;

#include <fmt/format.h>
#include <utf8.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>

module candela.util;

namespace candela {

namespace {

struct Range {
    char32_t first;
    char32_t last;
};

/// Unicode 15: the controls (Cc), the line and paragraph separators (Zl, Zp), all of
/// Default_Ignorable_Code_Point (zero-width and direction-changing characters, variation selectors, tags),
/// and the annotation characters. In ascending order.
constexpr std::array k_hidden = {
    Range{0x0000, 0x001f},   Range{0x007f, 0x009f},   Range{0x00ad, 0x00ad},   Range{0x034f, 0x034f},
    Range{0x061c, 0x061c},   Range{0x115f, 0x1160},   Range{0x17b4, 0x17b5},   Range{0x180b, 0x180f},
    Range{0x200b, 0x200f},   Range{0x2028, 0x202e},   Range{0x2060, 0x206f},   Range{0x3164, 0x3164},
    Range{0xfe00, 0xfe0f},   Range{0xfeff, 0xfeff},   Range{0xffa0, 0xffa0},   Range{0xfff0, 0xfffb},
    Range{0x1bca0, 0x1bca3}, Range{0x1d173, 0x1d17a}, Range{0xe0000, 0xe0fff},
};

bool is_hidden(char32_t c) {
    const auto range = std::ranges::lower_bound(k_hidden, c, {}, &Range::last);
    return range != k_hidden.end() && range->first <= c;
}

/// The number of ordinary visible characters at the beginning: most text has no others.
std::size_t plain_characters(std::string_view text) {
    const auto other = std::ranges::find_if_not(text, [](char c) { return c >= ' ' && c <= '~'; });
    return static_cast<std::size_t>(other - text.begin());
}

bool is_invalid(std::string_view character) {
    return character.size() == 1 && static_cast<unsigned char>(character[0]) >= 0x80;
}

}  // namespace

std::optional<char32_t> hidden_code_point(std::string_view character) {
    if (character.empty() || is_invalid(character)) return std::nullopt;
    const char* at = character.data();
    const auto c = static_cast<char32_t>(utf8::unchecked::next(at));
    return is_hidden(c) ? std::optional(c) : std::nullopt;
}

std::string printable(std::string_view text, LineBreaks line_breaks) {
    std::string result;
    result.reserve(text.size());
    while (true) {
        const std::size_t plain = plain_characters(text);
        result += text.substr(0, plain);
        text.remove_prefix(plain);
        if (text.empty()) return result;
        const std::string_view character = first_character(text);
        text.remove_prefix(character.size());
        const bool is_kept = character == "\t" || (character == "\n" && line_breaks == LineBreaks::kept);
        if (is_invalid(character)) {
            fmt::format_to(std::back_inserter(result), "\\x{{{:x}}}",
                           static_cast<unsigned char>(character[0]));
        } else if (const auto hidden = is_kept ? std::nullopt : hidden_code_point(character)) {
            fmt::format_to(std::back_inserter(result), "\\u{{{:x}}}", static_cast<std::uint32_t>(*hidden));
        } else {
            result += character;
        }
    }
}

}  // namespace candela
