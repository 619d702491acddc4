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

module candela.texture;

import candela.parallel;
import candela.simd;

namespace candela {

namespace {

// ---- levels

/// The texels of a row or column that one of the level above covers, and by how much: two, or three or four
/// where there is an odd one left over.
struct Cover {
    int first = 0;
    int count = 0;
    std::array<float, 4> weight{};
};

std::vector<Cover> covers_of(int count, int finer) {
    std::vector<Cover> covers(static_cast<std::size_t>(count));
    const double ratio = static_cast<double>(finer) / count;
    for (int i = 0; i < count; ++i) {
        const double begin = i * ratio, end = std::min((i + 1) * ratio, static_cast<double>(finer));
        Cover& cover = covers[static_cast<std::size_t>(i)];
        cover.first = static_cast<int>(begin);
        for (int k = cover.first; k < end && cover.count < 4; ++k) {
            const double covered = std::min(end, k + 1.0) - std::max(begin, static_cast<double>(k));
            cover.weight[static_cast<std::size_t>(cover.count++)] = static_cast<float>(covered / ratio);
        }
    }
    return covers;
}

void reduce(const MipMap::Level& from, const MipMap::Level& to, MipMap::Texels& texels) {
    const std::vector<Cover> columns = covers_of(to.width, from.width),
                             rows = covers_of(to.height, from.height);
    constexpr std::size_t k_texels = 16384;  // a task's
    const auto width = static_cast<std::size_t>(to.width), finer = static_cast<std::size_t>(from.width);
    parallel_for(static_cast<std::size_t>(to.height), k_texels / width + 1,
                 [&](std::size_t begin, std::size_t end) {
                     for (std::size_t y = begin; y < end; ++y) {
                         for (std::size_t x = 0; x < width; ++x) {
                             float sum[3] = {0.5f, 0.5f, 0.5f};
                             for (int j = 0; j < rows[y].count; ++j) {
                                 const std::size_t row =
                                     from.first + static_cast<std::size_t>(rows[y].first + j) * finer;
                                 for (int i = 0; i < columns[x].count; ++i) {
                                     const float weight = rows[y].weight[static_cast<std::size_t>(j)] *
                                                          columns[x].weight[static_cast<std::size_t>(i)];
                                     const std::uint16_t* const texel =
                                         &texels[4 * (row + static_cast<std::size_t>(columns[x].first + i))];
                                     for (std::size_t c = 0; c < 3; ++c)
                                         sum[c] += weight * static_cast<float>(texel[c]);
                                 }
                             }
                             std::uint16_t* const texel = &texels[4 * (to.first + y * width + x)];
                             for (std::size_t c = 0; c < 3; ++c)
                                 texel[c] = static_cast<std::uint16_t>(std::min(sum[c], 65535.0f));
                         }
                     }
                 });
}

// ---- look-up

constexpr std::size_t k_block = 256;

/// Where points lie in one of the levels: the texel to the upper left, the way to its neighbours, and the
/// weights of these.
struct Places {
    alignas(64) std::array<std::int32_t, k_block> texel, right, below;
    alignas(64) std::array<float, k_block> s, t;
};

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

/// `one_level`: all points are in the same, so that its size need not be fetched for each.
template <bool one_level>
struct PlacesLoop {
    CANDELA_BATCH_LOOP static void run(const std::int32_t* sizes, ConstVec2Span uv, bool repeats,
                                       const std::int32_t* level, int coarser, int last, std::size_t count,
                                       Places* places) {
        std::int32_t* const texel = places->texel.data();
        std::int32_t *const right = places->right.data(), *const below = places->below.data();
        float *const s = places->s.data(), *const t = places->t.data();
        const int of_first = 4 * (level[0] + coarser < last ? level[0] + coarser : last);
        const std::int32_t width_of_first = sizes[of_first], height_of_first = sizes[of_first + 1],
                           first_of_first = sizes[of_first + 2];
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            std::int32_t width = width_of_first, height = height_of_first, first = first_of_first;
            if constexpr (!one_level) {
                const int wanted = level[i] + coarser;
                const int number = 4 * (wanted < last ? wanted : last);
                width = sizes[number];
                height = sizes[number + 1];
                first = sizes[number + 2];
            }
            const float x = wrapped(uv.x[i], repeats) * static_cast<float>(width) - 0.5f;
            const float y = (1.0f - wrapped(uv.y[i], repeats)) * static_cast<float>(height) - 0.5f;
            const float left = kernel::floor(x), top = kernel::floor(y);
            s[i] = x - left;
            t[i] = y - top;
            const auto column = static_cast<std::int32_t>(left), row = static_cast<std::int32_t>(top);
            const std::int32_t before_x = repeats ? width - 1 : 0, after_x = repeats ? 0 : width - 1;
            const std::int32_t before_y = repeats ? height - 1 : 0, after_y = repeats ? 0 : height - 1;
            const std::int32_t x0 = column < 0 ? before_x : column;
            const std::int32_t x1 = column + 1 < width ? column + 1 : after_x;
            const std::int32_t y0 = row < 0 ? before_y : row;
            const std::int32_t y1 = row + 1 < height ? row + 1 : after_y;
            texel[i] = first + y0 * width + x0;
            right[i] = x1 - x0;
            below[i] = (y1 - y0) * width;
        }
    }
};

using Four = float __attribute__((vector_size(16)));
using Eight = float __attribute__((vector_size(32)));
using FourShorts = std::uint16_t __attribute__((vector_size(8)));
using EightShorts = std::uint16_t __attribute__((vector_size(16)));

/// A texel and its neighbour to the right, which is usually the next one.
[[gnu::always_inline]] inline void load_pair(const std::uint16_t* texel, std::ptrdiff_t right, Eight& pair) {
    EightShorts both;
    if (right == 1) [[likely]] {
        std::memcpy(&both, texel, sizeof both);
    } else {
        FourShorts a, b;
        std::memcpy(&a, texel, sizeof a);
        std::memcpy(&b, texel + 4 * right, sizeof b);
        both = __builtin_shufflevector(a, b, 0, 1, 2, 3, 4, 5, 6, 7);
    }
    pair = __builtin_convertvector(both, Eight);
}

[[gnu::always_inline]] inline Four bilinear(const std::uint16_t* texels, const Places& places,
                                            std::size_t i) {
    const std::uint16_t* const texel = texels + 4 * static_cast<std::ptrdiff_t>(places.texel[i]);
    const std::ptrdiff_t right = places.right[i], below = places.below[i];
    Eight upper, lower;
    load_pair(texel, right, upper);
    load_pair(texel + 4 * below, right, lower);
    const Eight column = upper + places.t[i] * (lower - upper);
    const Four a = __builtin_shufflevector(column, column, 0, 1, 2, 3);
    const Four b = __builtin_shufflevector(column, column, 4, 5, 6, 7);
    return a + places.s[i] * (b - a);
}

template <bool between_levels>
[[gnu::always_inline]] inline Four seen_at(const std::uint16_t* texels, const Places& finer,
                                           const Places& coarser, const float* fraction, std::size_t i) {
    const Four color = bilinear(texels, finer, i);
    if constexpr (!between_levels) return color;
    return color + fraction[i] * (bilinear(texels, coarser, i) - color);
}

[[gnu::always_inline]] inline void multiply_four(float* values, Four by) {
    Four four;
    std::memcpy(&four, values, sizeof four);
    four *= by;
    std::memcpy(values, &four, sizeof four);
}

/// The channels of a point lie side by side, since its texels may be anywhere; four points are transposed. No
/// loop that a compiler makes vectors of: these are.
template <bool between_levels>
struct MultiplyByHand {
    CANDELA_BATCH_LOOP static void run(const std::uint16_t* texels, const Places* finer,
                                       const Places* coarser, const float* fraction, std::size_t count,
                                       Vec3Span color) {
        constexpr float k_scale = 1.0f / 65535;
        const auto seen = [&](std::size_t i) __attribute__((always_inline)) {
            return k_scale * seen_at<between_levels>(texels, *finer, *coarser, fraction, i);
        };
        std::size_t i = 0;
        for (; i + 4 <= count; i += 4) {
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

MipMap::MipMap(int width, int height, Texels texels) : texels_(std::move(texels)) {
    std::size_t first = 0;
    for (;;) {
        levels_.push_back({width, height, first});
        first += static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
        if (width == 1 && height == 1) break;
        width = std::max(width / 2, 1);
        height = std::max(height / 2, 1);
    }
    texels_.resize(4 * first);
    for (std::size_t i = 1; i < levels_.size(); ++i) reduce(levels_[i - 1], levels_[i], texels_);
    for (const Level& level : levels_) {
        sizes_.push_back(level.width);
        sizes_.push_back(level.height);
        sizes_.push_back(static_cast<std::int32_t>(level.first));
        sizes_.push_back(0);
    }
}

void MipMap::multiply(TextureWrap wrap, std::size_t count, const TextureCoordinates& at,
                      const Vec3Span& color) const noexcept {
    const bool repeats = wrap == TextureWrap::repeat;
    const int last = static_cast<int>(levels_.size()) - 1;
    Levels levels;
    Places finer, coarser;
    std::int32_t fraction_bits = 0;
    std::int32_t* const fractions = &fraction_bits;
    const std::int32_t* const level = levels.finer.data();
    const float* const fraction = levels.fraction.data();
    for (std::size_t first = 0; first < count; first += k_block) {
        const std::size_t part = std::min(k_block, count - first);
        const TextureCoordinates here{at.uv.from(first), at.per_x.from(first), at.per_y.from(first)};
        multiversion<LevelLoop>(here, static_cast<float>(width()), static_cast<float>(height()),
                                static_cast<float>(last), part, &levels, fractions);
        const bool are_in_one = are_all_equal(std::span(level, part));
        const auto find_places = [&](int coarser_by, Places& places) {
            if (are_in_one) {
                multiversion<PlacesLoop<true>>(sizes_.data(), here.uv, repeats, level, coarser_by, last, part,
                                               &places);
            } else {
                multiversion<PlacesLoop<false>>(sizes_.data(), here.uv, repeats, level, coarser_by, last,
                                                part, &places);
            }
        };
        find_places(0, finer);
        const Places *const in_finer = &finer, *const in_coarser = &coarser;
        if (fraction_bits != 0) {
            find_places(1, coarser);
            multiversion<MultiplyByHand<true>>(texels_.data(), in_finer, in_coarser, fraction, part,
                                               color.from(first));
        } else {
            multiversion<MultiplyByHand<false>>(texels_.data(), in_finer, in_coarser, fraction, part,
                                                color.from(first));
        }
    }
}

}  // namespace candela
