// The interface of shading-model plugins.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>

export module candela.shading;

export import candela.descriptor;
export import candela.math;

export namespace candela {

/// Where light is evaluated; between those places its colour is interpolated.
enum class ShadingRate : int {
    face,      // once a triangle, at its centroid
    vertex,    // once a vertex
    fragment,  // once a pixel that sees the triangle
};

/// A mesh in world space, as far as vertex normals depend on it.
struct MeshView {
    ConstVec3Span position;                  // a vertex each
    std::span<const std::uint32_t> indices;  // three vertices a triangle, counter-clockwise seen from outside
    ConstVec3Span face_normal;               // a triangle each, unit; zero where the triangle has no area
    std::span<const std::uint32_t>
        smooth_group;  // a vertex each: vertices of one group share one normal, < group_count
    std::size_t vertex_count = 0;
    std::size_t group_count = 0;
    ConstVec3Span authored_normal;  // a vertex each, unit, from the object's file; null where it has none,
                                    // zero at a vertex that has none
};

/// What a shading model may need beyond the face normal and the interpolated vertex normal.
struct ShadingNeeds {
    bool uv = false;
    bool derivatives = false;
};

/// Points at which normals are wanted: centroids, vertices or fragments, as the lighting rate says. World
/// space.
struct ShadingPointBatch {
    std::size_t count = 0;
    ConstVec3Span face_normal;    // unit
    ConstVec3Span vertex_normal;  // interpolated perspective-correctly between the vertices; not unit
    ConstVec3Span barycentric;    // weights of the triangle's corners; of the first corner at rate `vertex`
    ConstVec2Span uv;             // null unless needed
    ConstVec3Span dpdu;           // partial derivatives of position; null unless needed
    ConstVec3Span dpdv;
};

/// A shading model (CA: "how the normal vector is calculated for polygons in the scene"). Any thread, any
/// batch size from 1; arrays need no alignment and do not overlap.
class CANDELA_API ShadingModel : public Instance {
  public:
    ~ShadingModel() override;

    virtual ShadingRate shading_rate() const noexcept = 0;
    virtual ShadingNeeds needs() const noexcept { return {}; }

    /// Writes a unit normal for each smooth group. Unless overridden: the authored normals where the object
    /// brings them, else the normalised sum of the normals of the faces that share the vertex (CA DD9;
    /// Gouraud 1971).
    virtual void vertex_normals(const MeshView& mesh, const Vec3Span& normals) const;

    /// Writes the unit normal of each point.
    virtual void normals(const ShadingPointBatch& points, const Vec3Span& normals) const = 0;
};

}  // namespace candela
