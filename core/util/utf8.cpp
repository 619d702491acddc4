module;

#include <utf8.h>

#include <algorithm>
#include <cstddef>
#include <optional>
#include <string_view>

module candela.util;

namespace candela {

std::optional<std::size_t> first_invalid_byte(std::string_view text) {
    const auto invalid = utf8::find_invalid(text.begin(), text.end());
    if (invalid == text.end()) return std::nullopt;
    return static_cast<std::size_t>(invalid - text.begin());
}

std::string_view first_character(std::string_view text) {
    constexpr std::size_t k_longest = 4;
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(text.size(), k_longest));
    if (utf8::find_invalid(text.begin(), end) == text.begin()) return text.substr(0, 1);
    auto next = text.begin();
    utf8::unchecked::next(next);
    return {text.begin(), next};
}

std::size_t character_count(std::string_view text) {
    std::size_t count = 0;
    for (; !text.empty(); ++count) text.remove_prefix(first_character(text).size());
    return count;
}

}  // namespace candela
