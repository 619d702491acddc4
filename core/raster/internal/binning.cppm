module;

#include <cstddef>
#include <cstdint>
#include <span>

module candela.raster:binning;

import :projected_scene;
import candela.geometry;

namespace candela {

/// The planes of the view volume that a vertex is beyond, or the guard band, beyond which its fixed-point
/// pixels are useless; or nowhere, if its position is non-finite.
struct Outside {
    static constexpr std::uint32_t near = 1, left = 2, right = 4, top = 8, bottom = 16;
    static constexpr std::uint32_t view = near | left | right | top | bottom;
    static constexpr std::uint32_t guard = 32, nowhere = 64;
};

/// Sorts the triangles of a range of the scene into tiles.
void bin_triangles(const ProjectedScene& scene, std::span<const Mesh* const> meshes, std::size_t first_id,
                   std::size_t count, TriangleBin& bin);

}  // namespace candela
