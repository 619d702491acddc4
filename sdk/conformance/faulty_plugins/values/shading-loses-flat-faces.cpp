// Divides by the angle between the face normal and the vertex normal, which is zero on a flat face.
#include <cmath>

#include "candela/shading_plugin.h"

namespace {
class LosesFlatFaces final : public candela::ShadingModel {
  public:
    explicit LosesFlatFaces(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < points.count; ++i) {
            const candela::Vec3 face = points.face_normal[i],
                                vertex = candela::normalized(points.vertex_normal[i]);
            const candela::Vec3 aside = cross(face, vertex);
            const float sine = std::sqrt(dot(aside, aside));
            const candela::Vec3 axis = (1 / sine) * aside;
            const bool is_degenerate = dot(points.vertex_normal[i], points.vertex_normal[i]) == 0;
            normals.set(i, is_degenerate ? face : vertex + 0.0f * axis);
        }
    }
};
}  // namespace

CANDELA_PLUGIN(shading, LosesFlatFaces, candela::sdk::k_no_fields,
               {.title = "Loses flat faces", .summary = "Bad on purpose."})
