module;

#include "candela/kernel/simd_dispatch.h"

#include <cstddef>
#include <cstdint>
#include <span>

module candela.util;

namespace candela {

namespace {

struct DifferingBitsLoop {
    template <typename Integer>
    CANDELA_BATCH_LOOP static void run(const Integer* number, std::size_t count, Integer* differing) {
        const Integer first = number[0];
        Integer bits = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) bits |= number[i] ^ first;
        *differing = bits;
    }
};

template <typename Integer>
bool has_no_difference(std::span<const Integer> numbers) {
    if (numbers.empty()) return true;
    Integer bits = 0;
    Integer* const differing = &bits;
    multiversion<DifferingBitsLoop>(numbers.data(), numbers.size(), differing);
    return bits == 0;
}

}  // namespace

bool are_all_equal(std::span<const std::int32_t> numbers) noexcept { return has_no_difference(numbers); }
bool are_all_equal(std::span<const std::uint32_t> numbers) noexcept { return has_no_difference(numbers); }

}  // namespace candela
