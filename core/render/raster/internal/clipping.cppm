module;

#include <array>
#include <cstdint>
#include <vector>

module candela.raster:clipping;

import :bounds;
import :projected_scene;

namespace candela {

/// Appends to `pieces` what is left of a triangle, given its vertices in the scene, in front of the near
/// plane and within the guard band, cut into triangles that may cover a sample.
void clip(const ProjectedScene& scene, const std::array<std::uint32_t, 3>& vertices, std::uint32_t id,
          bool two_sided, std::vector<RasterTriangle>& pieces);

}  // namespace candela
