// A vertex takes the normal of the last face, so that renumbering changes the picture.
#include "candela/shading_plugin.h"

namespace {
class LastFaceWins final : public candela::ShadingModel {
  public:
    explicit LastFaceWins(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void vertex_normals(const candela::MeshView& mesh, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < mesh.group_count; ++i) normals.set(i, {0, 1, 0});
        for (std::size_t c = 0; c < mesh.indices.size(); ++c)
            normals.set(mesh.smooth_group[mesh.indices[c]], mesh.face_normal[c / 3]);
    }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < points.count; ++i)
            normals.set(i, candela::normalized(points.vertex_normal[i]));
    }
};
}  // namespace

CANDELA_PLUGIN(shading, LastFaceWins, candela::sdk::k_no_fields,
               {.title = "Last face wins", .summary = "Bad on purpose."})
