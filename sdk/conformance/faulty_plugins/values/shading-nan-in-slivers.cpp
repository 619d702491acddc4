// Divides by the length of an edge of its triangle, which may be zero.
#include "candela/shading_plugin.h"

#include <cmath>

namespace {
class NanInSlivers final : public candela::ShadingModel {
  public:
    static constexpr candela::ShadingNeeds k_needs{.triangle = true};
    explicit NanInSlivers(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        const candela::TriangleBatch& triangle = *points.triangle;
        for (std::size_t i = 0; i < points.count; ++i) {
            const candela::Vec3 edge = triangle.position[1][i] - triangle.position[0][i];
            const float along = dot(edge, triangle.normal[0][i]) / dot(edge, edge);
            const candela::Vec3 normal = triangle.normal[0][i] - along * edge;
            normals.set(i, 1.0f / std::sqrt(dot(normal, normal)) * normal);
        }
    }
};
}  // namespace

CANDELA_PLUGIN(shading, NanInSlivers, candela::sdk::k_no_fields,
               {.title = "NaN in slivers", .summary = "Bad on purpose."})
