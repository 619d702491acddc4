module;

#include <cstdint>

module candela.raster:bounds;

import :projected_scene;

namespace candela {

[[gnu::always_inline]] inline std::int32_t least(std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::int32_t ab = a < b ? a : b;
    return ab < c ? ab : c;
}
[[gnu::always_inline]] inline std::int32_t most(std::int32_t a, std::int32_t b, std::int32_t c) {
    const std::int32_t ab = a > b ? a : b;
    return ab > c ? ab : c;
}

/// Whether a box in fixed-point pixels may contain samples of the picture.
struct SampleBounds {
    std::int32_t width, height;  // of the picture
    int bits;                    // of a pixel's fraction
    bool is_sparse;              // one sample per pixel, at its centre

    explicit SampleBounds(const ProjectedScene& scene)
        : width(scene.camera.width << scene.subpixel_bits),
          height(scene.camera.height << scene.subpixel_bits),
          bits(scene.subpixel_bits),
          is_sparse(scene.samples == 1) {}

    /// Along one axis, where the picture is `size` long.
    [[gnu::always_inline]] inline bool misses(std::int32_t low, std::int32_t high, std::int32_t size) const {
        const std::int32_t half = std::int32_t{1} << (bits - 1);
        const bool is_between = (low + half - 1) >> bits == (high + half) >> bits;
        return (high < 0) | (low >= size) | (is_sparse & is_between);
    }
};

}  // namespace candela
