module;

#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

module candela.texture;

import candela.simd;

namespace candela {

namespace {

constexpr std::size_t k_block = 256;

/// Where points lie in one of the levels: the texel to the upper left, the way to its neighbours, and the
/// weights of all four, two to a number: the upper ones in its lower half.
struct Places {
    alignas(64) std::array<std::int32_t, k_block> texel, right, below, left_weights, right_weights;
};

/// What weights of a point sum to, exactly, so that a picture of one colour has that colour everywhere. With
/// their sign, products of weights and texels fit into 32 bits, four of them added.
constexpr int k_weight_bits = 14;
constexpr float k_whole_weight = 1 << k_weight_bits;

/// `low` for what is no number.
CANDELA_KERNEL_INLINE float within(float x, float low, float high) {
    return x > low ? kernel::min(x, high) : low;
}

CANDELA_KERNEL_INLINE float wrapped(float x, bool repeats) {
    return within(repeats ? x - kernel::floor(x) : x, 0.0f, 1.0f);
}

/// The levels of points: the finer of the two between which each lies, and how far it is from it.
struct Levels {
    alignas(64) std::array<std::int32_t, k_block> finer;
    alignas(64) std::array<float, k_block> fraction;
};

/// The level of detail is the binary logarithm of how many texels a pixel's footprint is long. `fractions` is
/// zero where all points lie in a level, not between two.
struct LevelLoop {
    CANDELA_BATCH_LOOP static void run(TextureCoordinates at, float width, float height, float last,
                                       std::size_t count, Levels* levels, std::int32_t* fractions) {
        std::int32_t* const finer = levels->finer.data();
        float* const fraction = levels->fraction.data();
        std::int32_t bits = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float ax = at.per_x.x[i] * width, ay = at.per_x.y[i] * height;
            const float bx = at.per_y.x[i] * width, by = at.per_y.y[i] * height;
            const float squared = within(kernel::max(ax * ax + ay * ay, bx * bx + by * by), 1.0f, 1e18f);
            const float detail = kernel::min(0.5f * kernel::log2(squared), last);
            const float level = kernel::floor(detail);
            finer[i] = static_cast<std::int32_t>(level);
            fraction[i] = detail - level;
            bits |= std::bit_cast<std::int32_t>(detail - level);
        }
        *fractions = bits;
    }
};

CANDELA_KERNEL_INLINE float rounded(float x) { return kernel::floor(x + 0.5f); }

CANDELA_KERNEL_INLINE std::int32_t both(float low, float high) {
    return static_cast<std::int32_t>(low) | static_cast<std::int32_t>(high) << 16;
}

/// Where a point lies between the centres of texels.
struct Cell {
    std::int32_t column, row;  // of the texel to the upper left, which may be outside the picture by one
    std::int32_t left_weights, right_weights;
};

CANDELA_KERNEL_INLINE Cell cell_of(std::int32_t width, std::int32_t height, float u, float v, float weight) {
    const float x = u * static_cast<float>(width) - 0.5f, y = v * static_cast<float>(height) - 0.5f;
    const float left = kernel::floor(x), top = kernel::floor(y);
    const float lower = rounded(weight * (y - top)), upper = weight - lower;
    const float lower_right = rounded(lower * (x - left)), upper_right = rounded(upper * (x - left));
    return {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top),
            both(upper - upper_right, lower - lower_right), both(upper_right, lower_right)};
}

/// How much of a point's weight is its finer level's, or its coarser one's.
template <int coarser>
CANDELA_KERNEL_INLINE float weight_of_level(float fraction) {
    const float weight = rounded(k_whole_weight * fraction);
    return coarser == 0 ? k_whole_weight - weight : weight;
}

/// Level `coarser` of the two between which points lie, which are the same for all of them. Not for points
/// whose texels are on both sides of the picture's border; `border` says whether there are any.
template <int coarser>
struct InteriorLoop {
    CANDELA_BATCH_LOOP static void run(MipMap::Level level, ConstVec2Span uv, bool repeats,
                                       const float* fraction, std::size_t count, Places* places,
                                       std::int32_t* border) {
        std::int32_t* const texel = places->texel.data();
        std::int32_t* const left_weights = places->left_weights.data();
        std::int32_t* const right_weights = places->right_weights.data();
        const std::int32_t width = level.width, first = static_cast<std::int32_t>(level.first);
        const auto columns = static_cast<std::uint32_t>(level.width - 1),
                   rows = static_cast<std::uint32_t>(level.height - 1);
        std::int32_t any = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Cell cell =
                cell_of(width, level.height, wrapped(uv.x[i], repeats), 1.0f - wrapped(uv.y[i], repeats),
                        weight_of_level<coarser>(fraction[i]));
            texel[i] = first + cell.row * width + cell.column;
            left_weights[i] = cell.left_weights;
            right_weights[i] = cell.right_weights;
            any |= static_cast<std::uint32_t>(cell.column) < columns ? 0 : 1;
            any |= static_cast<std::uint32_t>(cell.row) < rows ? 0 : 1;
        }
        *border = any;
    }
};

/// The same for points of any levels, anywhere.
template <int coarser>
struct PlacesLoop {
    CANDELA_BATCH_LOOP static void run(const std::int32_t* sizes, ConstVec2Span uv, bool repeats,
                                       const Levels* levels, int last, std::size_t count, Places* places) {
        const std::int32_t* const level = levels->finer.data();
        const float* const fraction = levels->fraction.data();
        std::int32_t* const texel = places->texel.data();
        std::int32_t *const right = places->right.data(), *const below = places->below.data();
        std::int32_t* const left_weights = places->left_weights.data();
        std::int32_t* const right_weights = places->right_weights.data();
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const int wanted = level[i] + coarser;
            const int number = 4 * (wanted < last ? wanted : last);
            const std::int32_t width = sizes[number], height = sizes[number + 1], first = sizes[number + 2];
            const Cell cell =
                cell_of(width, height, wrapped(uv.x[i], repeats), 1.0f - wrapped(uv.y[i], repeats),
                        weight_of_level<coarser>(fraction[i]));
            const std::int32_t before_x = repeats ? width - 1 : 0, after_x = repeats ? 0 : width - 1;
            const std::int32_t before_y = repeats ? height - 1 : 0, after_y = repeats ? 0 : height - 1;
            const std::int32_t x0 = cell.column < 0 ? before_x : cell.column;
            const std::int32_t x1 = cell.column + 1 < width ? cell.column + 1 : after_x;
            const std::int32_t y0 = cell.row < 0 ? before_y : cell.row;
            const std::int32_t y1 = cell.row + 1 < height ? cell.row + 1 : after_y;
            texel[i] = first + y0 * width + x0;
            right[i] = x1 - x0;
            below[i] = (y1 - y0) * width;
            left_weights[i] = cell.left_weights;
            right_weights[i] = cell.right_weights;
        }
    }
};

using Four = float __attribute__((vector_size(16)));
using FourIntegers = std::int32_t __attribute__((vector_size(16)));
using EightShorts = std::int16_t __attribute__((vector_size(16)));

/// a0 b0 + a1 b1, a2 b2 + a3 b3, …
[[gnu::always_inline]] inline FourIntegers sums_of_products(EightShorts a, EightShorts b) {
#if defined(__SSE2__)
    return reinterpret_cast<FourIntegers>(
        _mm_madd_epi16(reinterpret_cast<__m128i>(a), reinterpret_cast<__m128i>(b)));
#else
    FourIntegers sums;
    for (int i = 0; i < 4; ++i) sums[i] = a[2 * i] * b[2 * i] + a[2 * i + 1] * b[2 * i + 1];
    return sums;
#endif
}

/// A texel and its neighbour to the right, less 32768: the products are of signed numbers.
template <bool is_interior>
[[gnu::always_inline]] inline EightShorts load_pair(const std::uint16_t* texel, std::ptrdiff_t right) {
    EightShorts pair;
    if (is_interior || right == 1) [[likely]] {
        std::memcpy(&pair, texel, sizeof pair);
    } else {
        std::memcpy(&pair, texel, sizeof pair / 2);
        std::memcpy(reinterpret_cast<char*>(&pair) + sizeof pair / 2, texel + 4 * right, sizeof pair / 2);
    }
    return pair ^ std::int16_t{-32768};
}

/// A level's texels for points that were found in it. `is_interior`: none of them is at the border, so that
/// their neighbours are the next ones, and `stride` texels on.
template <bool is_interior>
struct LevelTexels {
    const std::uint16_t* texels;
    std::ptrdiff_t stride;
    const Places* places;

    [[gnu::always_inline]] const std::uint16_t* upper(std::size_t i) const {
        return texels + 4 * static_cast<std::ptrdiff_t>(places->texel[i]);
    }
    [[gnu::always_inline]] const std::uint16_t* lower(std::size_t i) const {
        return upper(i) + 4 * (is_interior ? stride : std::ptrdiff_t{places->below[i]});
    }
    [[gnu::always_inline]] void prefetch(std::size_t i) const {
        __builtin_prefetch(upper(i));
        __builtin_prefetch(lower(i));
    }

    /// The weighted sum of a point's four texels, channel by channel.
    [[gnu::always_inline]] FourIntegers weighted(std::size_t i) const {
        const std::ptrdiff_t right = is_interior ? 1 : places->right[i];
        const EightShorts above = load_pair<is_interior>(upper(i), right),
                          below = load_pair<is_interior>(lower(i), right);
        const auto everywhere = [](std::int32_t weights) __attribute__((always_inline)) {
            return reinterpret_cast<EightShorts>(FourIntegers{weights, weights, weights, weights});
        };
        return sums_of_products(__builtin_shufflevector(above, below, 0, 8, 1, 9, 2, 10, 3, 11),
                                everywhere(places->left_weights[i])) +
               sums_of_products(__builtin_shufflevector(above, below, 4, 12, 5, 13, 6, 14, 7, 15),
                                everywhere(places->right_weights[i]));
    }
};

[[gnu::always_inline]] inline void multiply_four(float* values, Four by) {
    Four four;
    std::memcpy(&four, values, sizeof four);
    four *= by;
    std::memcpy(values, &four, sizeof four);
}

/// The channels of a point lie side by side, since its texels may be anywhere; four points are transposed. No
/// loop that a compiler makes vectors of: these are.
template <bool between_levels, bool is_interior>
struct MultiplyByHand {
    CANDELA_BATCH_LOOP static void run(LevelTexels<is_interior> finer, LevelTexels<is_interior> coarser,
                                       std::size_t count, Vec3Span color) {
        constexpr float k_scale = 1.0f / (65535 * k_whole_weight);
        constexpr std::int32_t k_offset = 32768 << k_weight_bits;
        constexpr std::size_t k_ahead = 32;
        const auto seen = [&](std::size_t i) __attribute__((always_inline)) {
            const FourIntegers sum =
                between_levels ? finer.weighted(i) + coarser.weighted(i) : finer.weighted(i);
            return k_scale * __builtin_convertvector(sum + k_offset, Four);
        };
        std::size_t i = 0;
        for (; i + 4 <= count; i += 4) {
            // A row of pixels may cross the rows of the picture; neighbours share a line more often than not.
            for (std::size_t next = i + k_ahead; next < i + k_ahead + 4 && next < count; next += 2) {
                finer.prefetch(next);
                if constexpr (between_levels) coarser.prefetch(next);
            }
            const Four a = seen(i), b = seen(i + 1), c = seen(i + 2), d = seen(i + 3);
            const Four ab = __builtin_shufflevector(a, b, 0, 4, 1, 5);
            const Four cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
            multiply_four(color.x + i, __builtin_shufflevector(ab, cd, 0, 1, 4, 5));
            multiply_four(color.y + i, __builtin_shufflevector(ab, cd, 2, 3, 6, 7));
            const Four blue_ab = __builtin_shufflevector(a, b, 2, 6, 3, 7);
            const Four blue_cd = __builtin_shufflevector(c, d, 2, 6, 3, 7);
            multiply_four(color.z + i, __builtin_shufflevector(blue_ab, blue_cd, 0, 1, 4, 5));
        }
        for (; i < count; ++i) {
            const Four one = seen(i);
            color.x[i] *= one[0];
            color.y[i] *= one[1];
            color.z[i] *= one[2];
        }
    }
};

}  // namespace

void MipMap::multiply(TextureWrap wrap, std::size_t count, const TextureCoordinates& at,
                      const Vec3Span& color) const noexcept {
    const bool repeats = wrap == TextureWrap::repeat;
    const int last = static_cast<int>(levels_.size()) - 1;
    Levels levels;
    Places finer, coarser;
    std::int32_t fraction_bits = 0, border = 0;
    std::int32_t *const fractions = &fraction_bits, *const is_at_border = &border;
    const Levels* const found = &levels;
    const float* const fraction = levels.fraction.data();
    for (std::size_t first = 0; first < count; first += k_block) {
        const std::size_t part = std::min(k_block, count - first);
        const TextureCoordinates here{at.uv.from(first), at.per_x.from(first), at.per_y.from(first)};
        multiversion<LevelLoop>(here, static_cast<float>(width()), static_cast<float>(height()),
                                static_cast<float>(last), part, &levels, fractions);
        const bool between_levels = fraction_bits != 0;
        const auto number = static_cast<std::size_t>(levels.finer[0]);
        const Level& level = levels_[number];
        const Level& next = levels_[std::min(number + 1, levels_.size() - 1)];
        bool is_interior = are_all_equal(std::span(std::as_const(levels.finer)).first(part));
        if (is_interior) {
            multiversion<InteriorLoop<0>>(level, here.uv, repeats, fraction, part, &finer, is_at_border);
            is_interior = border == 0;
        }
        if (is_interior && between_levels) {
            multiversion<InteriorLoop<1>>(next, here.uv, repeats, fraction, part, &coarser, is_at_border);
            is_interior = border == 0;
        }
        if (!is_interior) {
            multiversion<PlacesLoop<0>>(sizes_.data(), here.uv, repeats, found, last, part, &finer);
            if (between_levels)
                multiversion<PlacesLoop<1>>(sizes_.data(), here.uv, repeats, found, last, part, &coarser);
        }
        const auto multiply_by = [&]<bool is_between, bool inside>() {
            multiversion<MultiplyByHand<is_between, inside>>(
                LevelTexels<inside>{texels_.data(), level.width, &finer},
                LevelTexels<inside>{texels_.data(), next.width, &coarser}, part, color.from(first));
        };
        if (between_levels) {
            is_interior ? multiply_by.operator()<true, true>() : multiply_by.operator()<true, false>();
        } else {
            is_interior ? multiply_by.operator()<false, true>() : multiply_by.operator()<false, false>();
        }
    }
}

}  // namespace candela
