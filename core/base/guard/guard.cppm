module;

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

export module candela.guard;

export namespace candela {

/// What stands where nobody may write: a signalling NaN. No arithmetic leaves it as it is, not even adding
/// zero, so that its bits tell whether somebody did.
inline constexpr std::uint32_t k_guard_bits = 0x7fa5'5a5a;

inline bool is_guard(float x) { return std::bit_cast<std::uint32_t>(x) == k_guard_bits; }

inline void fill_with_guard(std::span<float> memory) {
    std::ranges::fill(memory, std::bit_cast<float>(k_guard_bits));
}

/// Whether all of it is still what fill_with_guard() left.
inline bool is_guard_intact(std::span<const float> memory) {
    // All elements, without an early exit: that is a vector loop.
    std::uint32_t differing = 0;
    for (const float x : memory) differing |= std::bit_cast<std::uint32_t>(x) ^ k_guard_bits;
    return differing == 0;
}

}  // namespace candela
