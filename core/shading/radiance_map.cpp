module;

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

module candela.shading;

import candela.api;
import candela.util;

namespace candela {

namespace {

/// Texels per row of the finest level.
constexpr int k_smallest_map = 16, k_largest_map = 512;

/// Colour times solid angle, summed over a texel's directions.
struct TexelSum {
    std::array<double, 4> sums{};  // red, green, blue; solid angle

    double luminance() const {
        return (0.2126 * sums[0] + 0.7152 * sums[1] + 0.0722 * sums[2]) / std::max(sums[3], 1e-300);
    }
    void add(const TexelSum& other) {
        for (std::size_t i = 0; i < sums.size(); ++i) sums[i] += other.sums[i];
    }
};

/// The direction at a place of the octahedral map, from -1 to 1 along its rows and columns.
Vec3 direction_at(double u, double v) {
    const double y = 1 - std::abs(u) - std::abs(v);
    const double x = y >= 0 ? u : std::copysign(1 - std::abs(v), u);
    const double z = y >= 0 ? v : std::copysign(1 - std::abs(u), v);
    const double scale = 1 / std::sqrt(x * x + y * y + z * z);
    return {static_cast<float>(scale * x), static_cast<float>(scale * y), static_cast<float>(scale * z)};
}

class FinestLevel {
  public:
    FinestLevel(const SkySource& sky, int size)
        : sky_(sky), size_(static_cast<std::size_t>(size)), texels_(size_ * size_) {
        const int columns = sky.sky_columns();
        const int detail =
            (columns + 2 * size - 1) / (2 * size);  // of a row of the map, in the light's columns
        const auto side = static_cast<std::size_t>(std::clamp(detail, 2, 4));
        for_rows([&](std::size_t row, Samples& samples) {
            for (std::size_t column = 0; column < size_; ++column)
                texels_[row * size_ + column] = measured(column, row, side, samples);
        });
        refine();
    }

    std::vector<TexelSum> take() { return std::move(texels_); }

  private:
    struct Samples {
        Vec3Arrays towards, seen;
    };

    template <class Body>
    void for_rows(Body body) const {
        parallel_for(size_, 8, [&](std::size_t first, std::size_t end) {
            Samples samples;
            samples.towards.resize(k_finest * k_finest);
            samples.seen.resize(k_finest * k_finest);
            for (std::size_t row = first; row < end; ++row) body(row, samples);
        });
    }

    /// Measures the texel at `side` x `side` places.
    TexelSum measured(std::size_t column, std::size_t row, std::size_t side, Samples& samples) const {
        const double step = 2 / static_cast<double>(size_ * side);
        std::array<double, k_finest * k_finest> weights{};
        const std::size_t count = side * side;
        for (std::size_t i = 0; i < count; ++i) {
            const std::size_t across = column * side + i % side, down = row * side + i / side;
            const double u = step * (static_cast<double>(across) + 0.5) - 1;
            const double v = step * (static_cast<double>(down) + 0.5) - 1;
            const Vec3 d = direction_at(u, v);
            const double sum = double{std::abs(d.x)} + double{std::abs(d.y)} + double{std::abs(d.z)};
            weights[i] = step * step * sum * sum * sum;
            samples.towards.span().set(i, d);
        }
        sky_.see(count, std::as_const(samples.towards).span(), samples.seen.span());
        TexelSum texel;
        for (std::size_t i = 0; i < count; ++i) {
            const double weight = weights[i];
            texel.add({{weight * double{samples.seen.x[i]}, weight * double{samples.seen.y[i]},
                        weight * double{samples.seen.z[i]}, weight}});
        }
        return texel;
    }

    /// Measures again, at more places, where neighbours differ: around the sun, at edges of lamps.
    void refine() {
        std::vector<double> luminance(texels_.size());
        std::ranges::transform(texels_, luminance.begin(), &TexelSum::luminance);
        for_rows([&](std::size_t row, Samples& samples) {
            for (std::size_t column = 0; column < size_; ++column) {
                double least = luminance[row * size_ + column], most = least;
                for (std::size_t y = std::max<std::size_t>(row, 1) - 1; y < std::min(row + 2, size_); ++y) {
                    for (std::size_t x = std::max<std::size_t>(column, 1) - 1;
                         x < std::min(column + 2, size_); ++x) {
                        least = std::min(least, luminance[y * size_ + x]);
                        most = std::max(most, luminance[y * size_ + x]);
                    }
                }
                if (most > k_contrast * least)
                    texels_[row * size_ + column] = measured(column, row, k_finest, samples);
            }
        });
    }

    static constexpr std::size_t k_finest = 8;
    static constexpr double k_contrast = 3;

    const SkySource& sky_;
    std::size_t size_;
    std::vector<TexelSum> texels_;
};

std::vector<TexelSum> halved(const std::vector<TexelSum>& level, std::size_t size) {
    std::vector<TexelSum> half(size / 2 * (size / 2));
    for (std::size_t y = 0; y < size; ++y) {
        for (std::size_t x = 0; x < size; ++x) half[y / 2 * (size / 2) + x / 2].add(level[y * size + x]);
    }
    return half;
}

}  // namespace

RadianceMap::RadianceMap(const SkySource& sky, int samples)
    : size_(static_cast<int>(std::bit_ceil(
          static_cast<unsigned>(std::clamp(sky.sky_columns() / 2, k_smallest_map, k_largest_map))))) {
    std::vector<TexelSum> level = FinestLevel(sky, size_).take();
    auto size = static_cast<std::size_t>(size_);
    texels_.reserve(4 * size * size);
    for (;; size /= 2) {
        for (const TexelSum& texel : level) {
            for (std::size_t i = 0; i < 3; ++i)
                texels_.push_back(static_cast<float>(texel.sums[i] / texel.sums[3]));
        }
        if (size == 1) break;
        level = halved(level, size);
    }
    const double integral = 4 * std::numbers::pi * level.front().luminance();
    if (integral > 0) density_ = static_cast<float>(samples / integral);
}

}  // namespace candela
