module;

#include <cstddef>
#include <cstdint>

module candela.raster:culling;

import :bounds;
import :projected_scene;

namespace candela {

/// Triangles of a mesh, and its projected vertices.
struct IndexedTriangles {
    const std::uint32_t* indices;
    const ScreenVertex* screen;
    std::size_t count;
    bool two_sided;
};

/// Selects the triangles that are worth sorting into tiles, many at once: those that face the observer, have
/// an area and may cover a sample.
struct Culling {
    static constexpr std::size_t k_size = 64;

    // One bit per triangle.
    std::uint64_t kept;
    std::uint64_t reversed;  // seen from behind
    std::uint64_t clipped;   // reaches beyond the guard band: must be clipped to find out

    // The boxes of the kept ones.
    alignas(64) std::int32_t left[k_size], right[k_size], top[k_size], bottom[k_size];

    /// Examines k_size of `triangles` from `first` on, or as many as there are.
    void look_at(const IndexedTriangles& triangles, std::size_t first, const SampleBounds& bounds);
};

}  // namespace candela
