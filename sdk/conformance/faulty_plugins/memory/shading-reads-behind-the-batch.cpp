// Reads one past the last point and one past the last vertex without using the values.
#include "candela/shading_plugin.h"

namespace {
class ReadsBehindTheBatch final : public candela::ShadingModel {
  public:
    explicit ReadsBehindTheBatch(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void vertex_normals(const candela::MeshView& mesh, const candela::Vec3Span& normals) const override {
        ShadingModel::vertex_normals(mesh, normals);
        [[maybe_unused]] const volatile float next = mesh.position.z[mesh.vertex_count];
    }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < points.count; ++i) normals.set(i, points.face_normal[i]);
        [[maybe_unused]] const volatile float next = points.face_normal.x[points.count];
    }
};
}  // namespace

CANDELA_PLUGIN(shading, ReadsBehindTheBatch, candela::sdk::k_no_fields,
               {.title = "Reads behind the batch", .summary = "Bad on purpose."})
