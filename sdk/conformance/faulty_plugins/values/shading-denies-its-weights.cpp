// It declares the default vertex normals, and weights the faces by their area: a flat mesh would ignore the
// weights.
#include "candela/shading_plugin.h"

namespace {
class WeighsByArea : public candela::ShadingModel {
  public:
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void vertex_normals(const candela::MeshView& mesh, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < mesh.group_count; ++i) normals.set(i, {});
        for (std::size_t c = 0; c < mesh.indices.size(); ++c) {
            const std::uint32_t* const corners = &mesh.indices[c - c % 3];
            const candela::Vec3 a = mesh.position[corners[0]];
            const std::uint32_t group = mesh.smooth_group[mesh.indices[c]];
            normals.set(group, normals[group] + candela::cross(mesh.position[corners[1]] - a,
                                                               mesh.position[corners[2]] - a));
        }
        for (std::size_t i = 0; i < mesh.group_count; ++i) {
            const candela::Vec3 sum = normals[i];
            normals.set(i, candela::length(sum) > 0 ? candela::normalized(sum) : candela::Vec3{0, 1, 0});
        }
    }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < points.count; ++i)
            normals.set(i, candela::normalized(points.vertex_normal[i]));
    }
};

class DeniesItsWeights final : public WeighsByArea {
  public:
    explicit DeniesItsWeights(const candela::sdk::NoParams&) {}
    using candela::ShadingModel::vertex_normals;  // hides the override from the SDK, not from the host
};
}  // namespace

CANDELA_PLUGIN(shading, DeniesItsWeights, candela::sdk::k_no_fields,
               {.title = "Denies its weights", .summary = "Bad on purpose."})
