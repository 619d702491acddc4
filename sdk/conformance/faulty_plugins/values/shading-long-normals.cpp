// Normals of length two.
#include "candela/shading_plugin.h"

namespace {
class LongNormals final : public candela::ShadingModel {
  public:
    explicit LongNormals(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void normals(const candela::ShadingPointBatch& points, const candela::Vec3Span& normals) const override {
        for (std::size_t i = 0; i < points.count; ++i) normals.set(i, 2.0f * points.face_normal[i]);
    }
};
}  // namespace

CANDELA_PLUGIN(shading, LongNormals, candela::sdk::k_no_fields,
               {.title = "Long normals", .summary = "Bad on purpose."})
