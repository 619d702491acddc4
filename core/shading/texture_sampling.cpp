module;

#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <utility>
#include <vector>

module candela.shading;

import :texture_footprints;
import candela.raster;
import candela.util;

namespace candela {

namespace {

/// The exact sum of a point's weights, so that a picture of one colour has that colour everywhere. The
/// products of weights and texels, with their sign, fit into 32 bits, even four of them added.
constexpr int k_weight_bits = 14;
constexpr int k_whole_weight = 1 << k_weight_bits;

/// `low` for NaN.
CANDELA_KERNEL_INLINE float within(float x, float low, float high) {
    return x > low ? kernel::min(x, high) : low;
}

/// How a picture continues along u or v.
struct Continuation {
    bool repeats, mirrors;

    explicit Continuation(TextureWrap wrap)
        : repeats(wrap == TextureWrap::repeat), mirrors(wrap == TextureWrap::mirror) {}
};

/// In a mirror, the period is 2, and its second half is reversed.
CANDELA_KERNEL_INLINE float wrapped(float x, Continuation c) {
    const float repeated = x - kernel::floor(x);
    const float mirrored = kernel::abs(x - 2 * kernel::floor(0.5f * x + 0.5f));
    return within(c.mirrors ? mirrored : c.repeats ? repeated : x, 0.0f, 1.0f);
}

/// Rounds a non-negative number to the nearest integer.
CANDELA_KERNEL_INLINE std::int32_t rounded(float x) { return static_cast<std::int32_t>(x + 0.5f); }

/// The level of detail is the binary logarithm of the length of a pixel's footprint in texels. `between` is
/// zero if all points lie in a level, not between two.
struct PointsLoop {
    CANDELA_BATCH_LOOP static void run(TextureCoordinates at, Continuation along_u, Continuation along_v,
                                       float width, float height, float last, std::size_t count,
                                       PicturePoints* points, std::int32_t* between) {
        float *const u = points->u.data(), *const v = points->v.data();
        std::int32_t *const finer = points->finer.data(), *const weight = points->coarser_weight.data();
        std::int32_t any = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float ax = at.per_x.x[i] * width, ay = at.per_x.y[i] * height;
            const float bx = at.per_y.x[i] * width, by = at.per_y.y[i] * height;
            const float squared = within(kernel::max(ax * ax + ay * ay, bx * bx + by * by), 1.0f, 1e18f);
            const float detail = kernel::min(0.5f * kernel::log2(squared), last);
            const float level = kernel::floor(detail);
            u[i] = wrapped(at.uv.x[i], along_u);
            v[i] = 1.0f - wrapped(at.uv.y[i], along_v);
            finer[i] = static_cast<std::int32_t>(level);
            weight[i] = rounded(k_whole_weight * (detail - level));
            any |= weight[i];
        }
        *between = any;
    }
};

/// The position of a point between the centres of texels.
struct Cell {
    std::int32_t column, row;  // of the texel to the upper left, which may be outside the picture by one
    std::int32_t left_weights, right_weights;
};

/// `weight`: of the four texels together.
CANDELA_KERNEL_INLINE Cell cell_of(std::int32_t width, std::int32_t height, float u, float v,
                                   std::int32_t weight) {
    const float x = u * static_cast<float>(width) - 0.5f, y = v * static_cast<float>(height) - 0.5f;
    const float left = kernel::floor(x), top = kernel::floor(y);
    const std::int32_t lower = rounded(static_cast<float>(weight) * (y - top)), upper = weight - lower;
    const std::int32_t lower_right = rounded(static_cast<float>(lower) * (x - left));
    const std::int32_t upper_right = rounded(static_cast<float>(upper) * (x - left));
    const std::int32_t right_weights = upper_right | lower_right << 16;
    return {static_cast<std::int32_t>(left), static_cast<std::int32_t>(top),
            (upper | lower << 16) - right_weights, right_weights};
}

/// The weight of the finer level of a point, or of the coarser one.
template <int coarser>
CANDELA_KERNEL_INLINE std::int32_t weight_of_level(std::int32_t coarser_weight) {
    return coarser == 0 ? k_whole_weight - coarser_weight : coarser_weight;
}

/// Level `coarser` (0 or 1) of the two between which the points lie, which are the same two for all of them.
/// Not for points whose texels are on both sides of the picture's border; `border` says whether there are
/// any.
template <int coarser>
struct InteriorLoop {
    CANDELA_BATCH_LOOP static void run(MipMap::Level level, const PicturePoints* points, std::size_t count,
                                       TexelFootprints* places, std::int32_t* border) {
        const float *const u = points->u.data(), *const v = points->v.data();
        const std::int32_t* const weight = points->coarser_weight.data();
        std::int32_t* const texel = places->texel.data();
        std::int32_t* const left_weights = places->left_weights.data();
        std::int32_t* const right_weights = places->right_weights.data();
        const std::int32_t width = level.width, height = level.height,
                           first = static_cast<std::int32_t>(level.first);
        const auto columns = static_cast<std::uint32_t>(width - 1),
                   rows = static_cast<std::uint32_t>(height - 1);
        std::int32_t any = 0;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Cell cell = cell_of(width, height, u[i], v[i], weight_of_level<coarser>(weight[i]));
            texel[i] = first + cell.row * width + cell.column;
            left_weights[i] = cell.left_weights;
            right_weights[i] = cell.right_weights;
            any |= static_cast<std::uint32_t>(cell.column) < columns ? 0 : 1;
            any |= static_cast<std::uint32_t>(cell.row) < rows ? 0 : 1;
        }
        *border = any;
    }
};

/// Like the above, for points of any levels, anywhere.
template <int coarser>
struct FootprintLoop {
    CANDELA_BATCH_LOOP static void run(const std::int32_t* sizes, bool repeats_x, bool repeats_y,
                                       const PicturePoints* points, int last, std::size_t count,
                                       TexelFootprints* places) {
        const float *const u = points->u.data(), *const v = points->v.data();
        const std::int32_t *const level = points->finer.data(), *const weight = points->coarser_weight.data();
        std::int32_t* const texel = places->texel.data();
        std::int32_t *const right = places->right.data(), *const below = places->below.data();
        std::int32_t* const left_weights = places->left_weights.data();
        std::int32_t* const right_weights = places->right_weights.data();
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const int wanted = level[i] + coarser;
            const int number = 4 * (wanted < last ? wanted : last);
            const std::int32_t width = sizes[number], height = sizes[number + 1], first = sizes[number + 2];
            const Cell cell = cell_of(width, height, u[i], v[i], weight_of_level<coarser>(weight[i]));
            const std::int32_t before_x = repeats_x ? width - 1 : 0, after_x = repeats_x ? 0 : width - 1;
            const std::int32_t before_y = repeats_y ? height - 1 : 0, after_y = repeats_y ? 0 : height - 1;
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

/// A texel and its neighbour, three channels each and two numbers of the next texel; for two points.
using EightShorts = std::int16_t __attribute__((vector_size(16)));
using SixteenShorts = std::int16_t __attribute__((vector_size(32)));
/// Three channels of two points, and a number without meaning behind each.
using EightIntegers = std::int32_t __attribute__((vector_size(32)));
using EightFloats = float __attribute__((vector_size(32)));
using SixteenIntegers = std::int32_t __attribute__((vector_size(64)));

constexpr std::size_t k_group = 8;

/// A level's texels for points that were found in it. `is_interior`: none of them is at the border, so that
/// their neighbours are the next texel and the one `stride` texels on. Vectors are passed by reference,
/// because not every instruction set has registers for them.
template <bool is_interior>
struct LevelTexels {
    const std::uint16_t* texels;
    std::ptrdiff_t stride;
    const TexelFootprints* places;

    [[gnu::always_inline]] const std::uint16_t* upper(std::size_t i) const {
        return texels + 3 * static_cast<std::ptrdiff_t>(places->texel[i]);
    }
    [[gnu::always_inline]] const std::uint16_t* lower(std::size_t i) const {
        return upper(i) + 3 * (is_interior ? stride : std::ptrdiff_t{places->below[i]});
    }
    [[gnu::always_inline]] void prefetch(std::size_t i) const {
        __builtin_prefetch(upper(i));
        __builtin_prefetch(lower(i));
    }

    /// A texel and its neighbour to the right.
    [[gnu::always_inline]] EightShorts load_pair(const std::uint16_t* texel, std::size_t i) const {
        EightShorts pair{};
        if (is_interior || places->right[i] == 1) [[likely]] {
            std::memcpy(&pair, texel, sizeof pair);
        } else {
            constexpr std::size_t k_size = 3 * sizeof *texel;
            std::memcpy(&pair, texel, k_size);
            std::memcpy(reinterpret_cast<char*>(&pair) + k_size, texel + 3 * std::ptrdiff_t{places->right[i]},
                        k_size);
        }
        return pair;
    }

    /// Adds the weighted texels of point k of the group from `first` on, and of point k + 4, to `sums`,
    /// channel by channel, less 32768 each: the factors are signed.
    template <int k>
    [[gnu::always_inline]] void add_weighted(std::size_t first, EightIntegers& sums) const {
        const std::size_t i = first + k, j = i + 4;
        EightIntegers left_weights, right_weights;  // of the whole group
        std::memcpy(&left_weights, &places->left_weights[first], sizeof left_weights);
        std::memcpy(&right_weights, &places->right_weights[first], sizeof right_weights);
        const EightShorts above_i = load_pair(upper(i), i), above_j = load_pair(upper(j), j);
        const EightShorts below_i = load_pair(lower(i), i), below_j = load_pair(lower(j), j);
        const SixteenShorts above =
            __builtin_shufflevector(above_i, above_j, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15) ^
            std::int16_t{-32768};
        const SixteenShorts below =
            __builtin_shufflevector(below_i, below_j, 0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15) ^
            std::int16_t{-32768};
        const SixteenShorts left =
            __builtin_shufflevector(above, below, 0, 16, 1, 17, 2, 18, 3, 19, 8, 24, 9, 25, 10, 26, 11, 27);
        const SixteenShorts right =
            __builtin_shufflevector(above, below, 3, 19, 4, 20, 5, 21, 6, 22, 11, 27, 12, 28, 13, 29, 14, 30);
        const EightIntegers by_left =
            __builtin_shufflevector(left_weights, left_weights, k, k, k, k, k + 4, k + 4, k + 4, k + 4);
        const EightIntegers by_right =
            __builtin_shufflevector(right_weights, right_weights, k, k, k, k, k + 4, k + 4, k + 4, k + 4);
        add_products(left, reinterpret_cast<SixteenShorts>(by_left), sums);
        add_products(right, reinterpret_cast<SixteenShorts>(by_right), sums);
    }

  private:
    /// a0 b0 + a1 b1, a2 b2 + a3 b3, …
    [[gnu::always_inline]] static void add_products(const SixteenShorts& a, const SixteenShorts& b,
                                                    EightIntegers& sums) {
        const SixteenIntegers products =
            __builtin_convertvector(a, SixteenIntegers) * __builtin_convertvector(b, SixteenIntegers);
        sums += __builtin_shufflevector(products, products, 0, 2, 4, 6, 8, 10, 12, 14) +
                __builtin_shufflevector(products, products, 1, 3, 5, 7, 9, 11, 13, 15);
    }
};

/// `values`: of `count` points, at most a group.
[[gnu::always_inline]] inline void multiply_group(float* values, const EightFloats& by, std::size_t count) {
    if (count < k_group) {
        for (std::size_t k = 0; k < count; ++k) values[k] *= by[k];
        return;
    }
    EightFloats group;
    std::memcpy(&group, values, sizeof group);
    group *= by;
    std::memcpy(values, &group, sizeof group);
}

/// The channels of a point are adjacent, since its texels may be anywhere; groups of points are transposed.
/// Positions are filled to the end of the last group. Vectorised by hand: compilers do not vectorise this
/// loop.
template <bool between_levels, bool is_interior>
struct MultiplyByHand {
    CANDELA_BATCH_LOOP static void run(LevelTexels<is_interior> finer, LevelTexels<is_interior> coarser,
                                       std::size_t count, Vec3Span color) {
        constexpr float k_scale = 1.0f / (65535.0f * k_whole_weight);
        constexpr std::int32_t k_offset = 32768 << k_weight_bits;
        constexpr std::size_t k_ahead = 32;
        for (std::size_t i = 0; i < count; i += k_group) {
            // A row of pixels may cross the rows of the picture; neighbours usually share a cache line.
            for (std::size_t next = i + k_ahead; next < i + k_ahead + k_group && next < count; next += 2) {
                finer.prefetch(next);
                if constexpr (between_levels) coarser.prefetch(next);
            }
            const auto seen = [&]<int k>(EightFloats& channels) __attribute__((always_inline)) {
                EightIntegers sums = EightIntegers{} + k_offset;
                finer.template add_weighted<k>(i, sums);
                if constexpr (between_levels) coarser.template add_weighted<k>(i, sums);
                channels = k_scale * __builtin_convertvector(sums, EightFloats);
            };
            EightFloats a, b, c, d;  // points 0 and 4, 1 and 5, 2 and 6, 3 and 7
            seen.template operator()<0>(a);
            seen.template operator()<1>(b);
            seen.template operator()<2>(c);
            seen.template operator()<3>(d);
            const EightFloats ab = __builtin_shufflevector(a, b, 0, 8, 1, 9, 4, 12, 5, 13);
            const EightFloats cd = __builtin_shufflevector(c, d, 0, 8, 1, 9, 4, 12, 5, 13);
            const EightFloats blue_ab = __builtin_shufflevector(a, b, 2, 10, 3, 11, 6, 14, 7, 15);
            const EightFloats blue_cd = __builtin_shufflevector(c, d, 2, 10, 3, 11, 6, 14, 7, 15);
            const std::size_t points = std::min(k_group, count - i);
            multiply_group(color.x + i, __builtin_shufflevector(ab, cd, 0, 1, 8, 9, 4, 5, 12, 13), points);
            multiply_group(color.y + i, __builtin_shufflevector(ab, cd, 2, 3, 10, 11, 6, 7, 14, 15), points);
            multiply_group(color.z + i, __builtin_shufflevector(blue_ab, blue_cd, 0, 1, 8, 9, 4, 5, 12, 13),
                           points);
        }
    }
};

/// Fills up the last group with copies of the last of `count` points.
std::size_t fill_group(PicturePoints& points, std::size_t count) {
    std::size_t end = count;
    for (; end % k_group != 0; ++end) {
        points.u[end] = points.u[count - 1];
        points.v[end] = points.v[count - 1];
        points.finer[end] = points.finer[count - 1];
        points.coarser_weight[end] = points.coarser_weight[count - 1];
    }
    return end;
}

}  // namespace

void TextureFootprints::find(const MipMap& picture, const std::array<TextureWrap, 2>& wraps, std::size_t of,
                             const TextureCoordinates& at) {
    count = of;
    width = picture.width();
    height = picture.height();
    const std::span<const MipMap::Level> levels = picture.levels();
    const Continuation along_u(wraps[0]), along_v(wraps[1]);
    const bool repeats_x = along_u.repeats, repeats_y = along_v.repeats;
    const int last = static_cast<int>(levels.size()) - 1;
    std::int32_t coarser_weights = 0, border = 0;
    std::int32_t *const between = &coarser_weights, *const is_at_border = &border;
    PicturePoints* const placed = &points;
    const PicturePoints* const found = &points;
    TexelFootprints *const in_finer = &finer, *const in_coarser = &coarser;
    multiversion<PointsLoop>(at, along_u, along_v, static_cast<float>(width), static_cast<float>(height),
                             static_cast<float>(last), count, placed, between);
    const std::size_t filled = fill_group(points, count);
    is_between_levels = coarser_weights != 0;
    level = static_cast<std::size_t>(points.finer[0]);
    is_interior = are_all_equal(std::span(std::as_const(points.finer)).first(count));
    if (is_interior) {
        multiversion<InteriorLoop<0>>(levels[level], found, filled, in_finer, is_at_border);
        is_interior = border == 0;
    }
    if (is_interior && is_between_levels) {
        multiversion<InteriorLoop<1>>(levels[std::min(level + 1, levels.size() - 1)], found, filled,
                                      in_coarser, is_at_border);
        is_interior = border == 0;
    }
    if (is_interior) return;
    const std::int32_t* const sizes = picture.sizes().data();
    multiversion<FootprintLoop<0>>(sizes, repeats_x, repeats_y, found, last, filled, in_finer);
    if (is_between_levels)
        multiversion<FootprintLoop<1>>(sizes, repeats_x, repeats_y, found, last, filled, in_coarser);
}

void MipMap::multiply(const TextureFootprints& at, const Vec3Span& color) const noexcept {
    const Level& level = levels_[at.level];
    const Level& next = levels_[std::min(at.level + 1, levels_.size() - 1)];
    const auto multiply_by = [&]<bool is_between, bool inside>() {
        multiversion<MultiplyByHand<is_between, inside>>(
            LevelTexels<inside>{texels_.data(), level.width, &at.finer},
            LevelTexels<inside>{texels_.data(), next.width, &at.coarser}, at.count, color);
    };
    if (at.is_between_levels) {
        at.is_interior ? multiply_by.operator()<true, true>() : multiply_by.operator()<true, false>();
    } else {
        at.is_interior ? multiply_by.operator()<false, true>() : multiply_by.operator()<false, false>();
    }
}

}  // namespace candela
