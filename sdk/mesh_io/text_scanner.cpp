#include "mesh_io/text_scanner.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <system_error>

namespace mesh_io {

namespace {

/// A value that std::from_chars calls out of range is either too large or too small.
double beyond_range(std::string_view word) {
    const bool is_negative = word.starts_with('-');
    bool is_small = true;
    const std::size_t e = word.find_first_of("eE");
    if (e != std::string_view::npos) {
        is_small = word.substr(e + 1).starts_with('-');
    } else {
        for (const char c : word.substr(0, word.find('.'))) is_small &= c < '1' || c > '9';
    }
    const double size = is_small ? 0 : std::numeric_limits<double>::infinity();
    return is_negative ? -size : size;
}

/// The forms that Microsoft's C library printed for twenty years.
std::optional<double> old_non_finite(std::string_view word) {
    const bool is_negative = word.starts_with('-');
    if (is_negative) word.remove_prefix(1);
    if (!word.starts_with("1.#")) return std::nullopt;
    const double infinity = std::numeric_limits<double>::infinity();
    if (word.starts_with("1.#INF")) return is_negative ? -infinity : infinity;
    return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

std::optional<double> number_from(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const char* const end = std::to_address(word.end());
    const auto [stop, problem] = std::from_chars(std::to_address(word.begin()), end, value);
    if (stop != end || word.empty()) return old_non_finite(word);
    if (problem == std::errc::result_out_of_range) return beyond_range(word);
    if (problem != std::errc()) return std::nullopt;
    return value;
}

std::optional<std::int64_t> integer_from(std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    std::int64_t value = 0;
    const char* const end = std::to_address(word.end());
    const auto [stop, problem] = std::from_chars(std::to_address(word.begin()), end, value);
    if (stop == end && problem == std::errc() && !word.empty()) return value;
    const std::optional<double> number = number_from(word);
    constexpr double k_most = 9e15;
    if (!number || !(std::abs(*number) < k_most) || *number != std::floor(*number)) return std::nullopt;
    return static_cast<std::int64_t>(*number);
}

std::string in_quotes(std::string_view word) {
    constexpr std::size_t k_longest = 40;
    std::string text = "'";
    for (const char c : word.substr(0, k_longest)) text += c >= ' ' && c <= '~' ? c : '?';
    if (word.size() > k_longest) text += "...";
    return text + "'";
}

}  // namespace mesh_io
