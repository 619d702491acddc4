module;

#include <cstddef>
#include <cstdint>

module candela.fragments:interpolation;

import candela.math;
import candela.mesh;
import candela.raster;

namespace candela {

/// A triangle's corners, as they are projected and as they are, and its normal.
struct TriangleAttributes {
    ProjectedVertex projected[3];
    MeshVertex corner[3];
    Vec3 face_normal;
};

/// What becomes of a fragment's place on its triangle.
struct InterpolatedSpans {
    Vec3Span barycentric, position, vertex_normal, face_normal;
};

/// Interpolates over `count` fragments of one triangle, at (x, y), and over what lies beyond them up to whole
/// vectors.
void interpolate(const TriangleAttributes& triangle, std::size_t count, const float* x, const float* y,
                 const InterpolatedSpans& points);

/// A mesh and its vertices as they are projected.
struct IndexedMesh {
    const std::uint32_t* indices;
    const ProjectedVertex* projected;
    const MeshVertex* vertices;
    ConstVec3Span face_normal;
};

/// Interpolates over `count` fragments of a triangle each, at (x, y), and over what lies beyond them up to
/// whole vectors. The same numbers as interpolate().
void interpolate_each(const IndexedMesh& mesh, std::size_t count, const std::uint32_t* triangle,
                      const float* x, const float* y, const InterpolatedSpans& points);

}  // namespace candela
