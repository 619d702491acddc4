// One layer of a tile whose surfaces let what is behind them through.
module;

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

module candela.raster;

namespace candela {

namespace {

/// A triangle that samples of one pixel see: how many, the sum of their positions in sixteenths, and the sum
/// of what it covers of them.
struct CoveringTriangle {
    std::uint32_t triangle;
    int count, x, y;
    float covered;
};

/// The surfaces that one pixel's samples see, in the order of the samples.
struct PixelLayer {
    std::array<CoveringTriangle, 16> seen;
    std::size_t size = 0;
    float background = 0;

    void add(std::uint32_t triangle, SamplePosition at, float covered) {
        std::size_t k = 0;
        while (k < size && seen[k].triangle != triangle) ++k;
        if (k == size) seen[size++] = {triangle, 0, 0, 0, 0};
        ++seen[k].count;
        seen[k].x += at.x;
        seen[k].y += at.y;
        seen[k].covered += covered;
    }
};

}  // namespace

void TileFragments::collect_layer(const ProjectedScene& scene, const TileVisibility& visibility,
                                  std::span<const float> left, std::span<const float> opacity,
                                  bool is_nearest) {
    begin();
    const int samples = visibility.samples;
    const float share = 1 / static_cast<float>(samples);
    const std::span<const SamplePosition> pattern = sample_pattern(samples);
    for (int row = 0; row < visibility.height; ++row) {
        const auto top = static_cast<float>(visibility.y0 + row);
        for (int column = 0; column < visibility.width; ++column) {
            const auto pixel = static_cast<std::uint32_t>(row * visibility.stride + column);
            PixelLayer layer;
            for (int s = 0; s < samples; ++s) {
                const std::size_t at = static_cast<std::size_t>(s) * visibility.plane() + pixel;
                if (left[at] <= 0) continue;
                if (visibility.triangle[at] == k_no_triangle) {
                    layer.background += left[at];
                } else {
                    layer.add(visibility.triangle[at], pattern[static_cast<std::size_t>(s)],
                              left[at] * opacity[at]);
                }
            }
            const auto column_left = static_cast<float>(visibility.x0 + column);
            for (std::size_t k = 0; k < layer.size; ++k) {
                const CoveringTriangle& s = layer.seen[k];
                // Where collect() puts them.
                const bool is_whole = s.count == samples;
                const float sixteenths = 16 * static_cast<float>(s.count);
                const float x = is_whole ? 0.5f : static_cast<float>(s.x) / sixteenths;
                const float y = is_whole ? 0.5f : static_cast<float>(s.y) / sixteenths;
                add_fragment(scene, s.triangle,
                             {.pixel = pixel,
                              .count = 1,
                              .x = column_left + x,
                              .y = top + y,
                              .weight = share * s.covered},
                             column);
            }
            if (layer.size > 0) ++pixels_seen_;
            const bool is_one_fragment = layer.size == 1 && share * layer.seen[0].covered == 1;
            if (layer.background > 0 || (is_nearest && !is_one_fragment))
                add_background(pixel, column, share * layer.background);
        }
    }
    sort();
}

}  // namespace candela
