module;

#include <cstddef>
#include <cstdint>

module candela.raster:interpolation;

import :camera;
import :projected_scene;
import :visibility;
import candela.api;
import candela.geometry;

namespace candela {

/// A triangle's vertices, projected and in world space, and its normal.
struct TriangleAttributes {
    ProjectedVertex projected[3];
    MeshVertex corner[3];
    Vec3 face_normal;
    float u[3]{}, v[3]{};
};

/// The attributes computed at a fragment.
enum class Interpolated {
    barycentric,                 // only barycentric coordinates
    position_and_normal,         // position and vertex normal: what lighting of smooth surfaces needs
    position_and_normal_and_uv,  // also texture coordinates with their derivatives
    all_but_uv,
    all,
    uv,  // only texture coordinates with their derivatives
};

/// Whether `what` includes texture coordinates, which come with their derivatives.
constexpr bool has_uv(Interpolated what) {
    return what == Interpolated::position_and_normal_and_uv || what == Interpolated::all ||
           what == Interpolated::uv;
}
/// Whether `what` includes positions and vertex normals.
constexpr bool has_points(Interpolated what) {
    return what != Interpolated::barycentric && what != Interpolated::uv;
}
/// Whether `what` includes barycentric coordinates and face normals.
constexpr bool has_faces(Interpolated what) {
    return what == Interpolated::all_but_uv || what == Interpolated::all;
}

/// Destinations of interpolated values.
struct InterpolatedSpans {
    Vec3Span barycentric, position, vertex_normal, face_normal;
    Vec2Span uv, uv_per_x, uv_per_y;
};

/// Interpolates over `count` fragments of one triangle, at (x, y), and writes whole vectors, past `count` if
/// necessary.
void interpolate(Interpolated what, const TriangleAttributes& triangle, std::size_t count, const float* x,
                 const float* y, const InterpolatedSpans& points);

/// A mesh with its projected vertices.
struct IndexedMesh {
    const std::uint32_t* indices;
    const ProjectedVertex* projected;
    const MeshVertex* vertices;
    ConstVec3Span face_normal;
    ConstVec2Span uv;  // empty if the mesh has none
};

/// Interpolates over `count` fragments of one triangle each, at (x, y), and writes whole vectors, past
/// `count` if necessary. Yields the same numbers as interpolate().
void interpolate_each(Interpolated what, const IndexedMesh& mesh, std::size_t count,
                      const std::uint32_t* triangle, const float* x, const float* y,
                      const InterpolatedSpans& points);

}  // namespace candela
