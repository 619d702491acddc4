// Attributes of a mesh at points of its triangles.
module;

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

module candela.raster:attributes;

import :points;
import candela.api;
import candela.geometry;

namespace candela {

/// The vertices of a triangle.
using Indices = std::array<std::uint32_t, 3>;

inline Indices corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const std::size_t first = 3 * std::size_t{triangle};
    return {mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]};
}

/// Computes colour, uv, derivatives and triangle of points with known barycentric coordinates; channels are
/// left to blend_channels().
void blend_attributes(const Mesh& mesh, const Indices& vertices, PointNeeds needs, std::size_t first,
                      std::size_t count, SurfacePoints& points);

/// Needs channels only of a mesh that has them, and makes room for these.
void take_channels(const Mesh& mesh, PointNeeds& needs, SurfacePoints& points);

/// Computes the mesh's channels from number `channel` on.
void blend_channels(const Mesh& mesh, const Indices& vertices, std::size_t channel, std::size_t first,
                    std::size_t count, SurfacePoints& points);

/// Evaluates point `i` of a batch, a position on a triangle.
void evaluate_point(const Mesh& mesh, std::uint32_t triangle, Vec3 weight, PointNeeds needs, std::size_t i,
                    SurfacePoints& points);

/// Sets the triangle of each point, if they are needed.
void set_triangles(PointNeeds needs, std::span<const std::uint32_t> triangles, SurfacePoints& points);

/// Marks all points as seen from the front. Writes nothing if the last batch's points were as well.
void face_forward(SurfacePoints& points);

}  // namespace candela
