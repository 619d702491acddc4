module;

#include <cstddef>
#include <cstdint>

module candela.raster:small_triangles;

import :projected_scene;

namespace candela {

/// Triangles whose box covers at most eight by four pixels or four by eight, processed together, with one
/// sample per pixel. Their coverage and depth depend on the triangle alone, not on the tile.
struct SmallTriangles {
    static constexpr std::size_t k_size = 64;

    alignas(64) std::int32_t is_small[k_size];      // otherwise the rest is undefined
    alignas(64) std::int32_t x[k_size], y[k_size];  // of the box's first pixel
    alignas(64) std::int32_t is_tall[k_size];
    // Bit 4 * row + column of a block of four by four pixels. The bits above are those of a second block:
    // below the first if the box is tall, otherwise to its right.
    alignas(64) std::uint32_t covered[k_size];
    alignas(64) float depth[k_size];  // at the first pixel
    alignas(64) float to_right[k_size], down[k_size];

    /// Sets up `count` <= k_size triangles with vertices in `screen`.
    void set_up(const ScreenVertex* screen, const BinnedTriangle* triangles, std::size_t count,
                int subpixel_bits);
};

}  // namespace candela
