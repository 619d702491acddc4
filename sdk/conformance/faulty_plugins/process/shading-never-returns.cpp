#include <unistd.h>

#include "candela/shading_plugin.h"

namespace {
class NeverReturns final : public candela::ShadingModel {
  public:
    explicit NeverReturns(const candela::sdk::NoParams&) {}
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void normals(const candela::ShadingPointBatch&, const candela::Vec3Span&) const override {
        for (;;) ::pause();
    }
};
}  // namespace

CANDELA_PLUGIN(shading, NeverReturns, candela::sdk::k_no_fields,
               {.title = "Never returns", .summary = "Bad on purpose."})
