// The interface of shading-model plugins.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// Where light is evaluated; in between, its colour is interpolated.
enum class ShadingRate : int {
    face,      // once per triangle, at its centroid
    vertex,    // once per vertex
    fragment,  // once per pixel that sees the triangle
};

/// The parts of a mesh, in world space, that vertex normals depend on.
struct MeshView {
    ConstVec3Span position;                  // per vertex
    std::span<const std::uint32_t> indices;  // three per triangle, counter-clockwise seen from outside
    ConstVec3Span face_normal;               // per triangle, unit; zero if the triangle has no area
    std::span<const std::uint32_t>
        smooth_group;  // per vertex, < group_count: vertices of one group share one normal
    std::size_t vertex_count = 0;
    std::size_t group_count = 0;
    ConstVec3Span authored_normal;  // per vertex, unit, from the object's file; null if it has none, zero at
                                    // a vertex without one
};

/// The triangle of each point, as its vertices, counter-clockwise seen from outside. World space.
struct TriangleBatch {
    std::array<ConstVec3Span, 3> position;  // metres
    std::array<ConstVec3Span, 3> normal;    // vertex normals, unit
};

/// Points at which normals are needed: centroids, vertices or fragments, depending on the shading rate. World
/// space.
struct ShadingPointBatch {
    std::size_t count = 0;
    // Each is null unless needed: a plugin declares its ShadingNeeds in its descriptor.
    ConstVec3Span face_normal;    // unit
    ConstVec3Span vertex_normal;  // interpolated perspective-correctly between the vertices; not unit
    ConstVec3Span barycentric;    // weights of the triangle's vertices; of the first one at rate `vertex`
    ConstVec2Span uv;
    ConstVec3Span dpdu;  // partial derivatives of position
    ConstVec3Span dpdv;
    const TriangleBatch* triangle = nullptr;  // null at rate `vertex`
};

/// A shading model (CA: "how the normal vector is calculated for polygons in the scene"). Any thread, any
/// batch size from 1; arrays have as many elements as there are points, vertices or triangles, and nothing
/// outside them may be read or written; they may be unaligned and do not alias.
class CANDELA_EXPORT ShadingModel : public Instance {
  public:
    ~ShadingModel() override;

    virtual ShadingRate shading_rate() const noexcept = 0;

    /// Writes the unit normal of each point.
    virtual void normals(const ShadingPointBatch& points, const Vec3Span& normals) const = 0;

    /// Writes a unit normal for each smooth group. By default, the authored normals if the object has any,
    /// otherwise the normalised sum of the normals of the faces that share the vertex (CA DD9; Gouraud 1971).
    virtual void vertex_normals(const MeshView& mesh, const Vec3Span& normals) const;
};

}  // namespace candela
