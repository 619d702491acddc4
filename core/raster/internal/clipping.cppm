module;

#include <array>
#include <cstdint>
#include <vector>

module candela.raster:clipping;

import :bounds;
import :projected_scene;

namespace candela {

/// Clips a triangle, given its vertices in the scene, against the near plane and the guard band, and appends
/// the rest to `pieces`, cut into triangles that may cover a sample.
void clip(const ProjectedScene& scene, const std::array<std::uint32_t, 3>& vertices, std::uint32_t id,
          bool two_sided, std::vector<RasterTriangle>& pieces);

}  // namespace candela
