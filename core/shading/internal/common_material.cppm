module;

#include <cstddef>

module candela.shading:common_material;

import :surface;
import :texture;
import candela.api;
import candela.raster;

namespace candela {

/// Where textures are read.
TexturedPoints textured(const SurfacePoints& points);

/// The emission of points whose textures have been evaluated.
void find_emission(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
                   const Vec3Span& values);
void add_emission(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
                  const Vec3Span& intensity);

/// The factor of ambient light at a point.
float occlusion_at(const SurfaceModels& surface, const SurfacePoints& points, std::size_t point);
void occlude(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
             const Vec3Span& ambient);

}  // namespace candela
