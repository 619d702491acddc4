#include "filter.h"

#include <algorithm>
#include <cstring>

namespace {

/// How many of `count` bytes differ.
std::size_t differences(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
    constexpr std::size_t k_counted_in_bytes = 240;  // many at a time, in vectors of small numbers
    std::size_t sum = 0;
    for (std::size_t begin = 0; begin < count; begin += k_counted_in_bytes) {
        const std::size_t end = std::min(begin + k_counted_in_bytes, count);
        std::uint8_t some = 0;
        for (std::size_t i = begin; i < end; ++i) some = static_cast<std::uint8_t>(some + (a[i] != b[i]));
        sum += some;
    }
    return sum;
}

void subtract(const std::uint8_t* a, const std::uint8_t* b, std::size_t count, std::uint8_t* result) {
    for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<std::uint8_t>(a[i] - b[i]);
}

}  // namespace

void filter_row(std::span<const std::uint8_t> row, const std::uint8_t* above, std::uint8_t* result) {
    enum : std::uint8_t { k_sub = 1, k_up = 2 };
    const std::uint8_t* const left = row.data();
    const std::span<const std::uint8_t> rest = row.subspan(k_pixel);
    if (above != nullptr &&
        differences(row.data(), above, row.size()) <= differences(rest.data(), left, rest.size())) {
        *result++ = k_up;
        subtract(row.data(), above, row.size(), result);
    } else {
        *result++ = k_sub;
        std::memcpy(result, row.data(), k_pixel);
        subtract(rest.data(), left, rest.size(), result + k_pixel);
    }
}
