#include "filter.h"

#include <cstring>

#include "candela/kernel/simd_dispatch.h"

namespace {

/// For fewer than 256 bytes, so that many counters fit into a vector of bytes.
[[gnu::always_inline]] inline std::uint8_t differences_in_block(const std::uint8_t* a, const std::uint8_t* b,
                                                                std::size_t count) {
    std::uint8_t sum = 0;
    CANDELA_VECTORIZE
    for (std::size_t i = 0; i < count; ++i) sum = static_cast<std::uint8_t>(sum + (a[i] != b[i]));
    return sum;
}

struct DifferencesLoop {
    CANDELA_BATCH_LOOP static void run(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                                       std::size_t* differences) {
        constexpr std::size_t k_block = 128;  // whole vectors
        std::size_t sum = 0, done = 0;
        for (; done + k_block <= count; done += k_block)
            sum += differences_in_block(a + done, b + done, k_block);
        *differences = sum + differences_in_block(a + done, b + done, count - done);
    }
};

/// The number of differing bytes among `count`.
std::size_t differences(const std::uint8_t* a, const std::uint8_t* b, std::size_t count) {
    std::size_t result = 0;
    std::size_t* const found = &result;
    candela::multiversion<DifferencesLoop>(a, b, count, found);
    return result;
}

struct SubtractLoop {
    CANDELA_BATCH_LOOP static void run(const std::uint8_t* a, const std::uint8_t* b, std::size_t count,
                                       std::uint8_t* result) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) result[i] = static_cast<std::uint8_t>(a[i] - b[i]);
    }
};

}  // namespace

void filter_row(std::span<const std::uint8_t> row, const std::uint8_t* above, std::uint8_t* result) {
    enum : std::uint8_t { k_sub = 1, k_up = 2 };
    const std::uint8_t* const left = row.data();
    const std::span<const std::uint8_t> rest = row.subspan(k_pixel);
    if (above != nullptr &&
        std::memcmp(row.data(), above, row.size()) == 0) {  // a background is done quickly
        *result++ = k_up;
        std::memset(result, 0, row.size());
    } else if (above != nullptr &&
               differences(row.data(), above, row.size()) <= differences(rest.data(), left, rest.size())) {
        *result++ = k_up;
        candela::multiversion<SubtractLoop>(row.data(), above, row.size(), result);
    } else {
        *result++ = k_sub;
        std::memcpy(result, row.data(), k_pixel);
        candela::multiversion<SubtractLoop>(rest.data(), left, rest.size(), result + k_pixel);
    }
}
