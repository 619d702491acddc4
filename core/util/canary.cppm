module;

#include <algorithm>
#include <bit>
#include <cstdint>
#include <span>

export module candela.util:canary;

export namespace candela {

/// The canary in memory that plugins must not write: a signalling NaN. No arithmetic preserves it, not even
/// adding zero, so its bits reveal any write.
inline constexpr std::uint32_t k_canary_bits = 0x7fa5'5a5a;

inline bool is_canary(float x) { return std::bit_cast<std::uint32_t>(x) == k_canary_bits; }

inline void fill_with_canary(std::span<float> memory) {
    std::ranges::fill(memory, std::bit_cast<float>(k_canary_bits));
}

/// Whether the memory still contains only what fill_with_canary() wrote.
inline bool is_canary_intact(std::span<const float> memory) {
    // Looks at all elements, without an early exit, so that the loop is vectorised.
    std::uint32_t differing = 0;
    for (const float x : memory) differing |= std::bit_cast<std::uint32_t>(x) ^ k_canary_bits;
    return differing == 0;
}

}  // namespace candela
