// A ring that is laid out as convex.
#include "candela/shape_plugin.h"

namespace {

using candela::kernel::vec3;
using candela::sdk::Topology;

constexpr float k_turn = 6.2831853f;

CANDELA_KERNEL_INLINE vec3 position(candela::sdk::NoParams, float u, float v) {
    const float r = 1.0f + 0.3f * candela::kernel::cos(k_turn * v);
    return vec3(r * candela::kernel::sin(k_turn * u), 0.3f * candela::kernel::sin(k_turn * v),
                r * candela::kernel::cos(k_turn * u));
}
CANDELA_KERNEL_INLINE vec3 derivative(candela::sdk::NoParams, float, float) { return vec3(0.0f); }

class ConvexRing final : public candela::Shape {
  public:
    explicit ConvexRing(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        constexpr Topology k_topology{.u_is_periodic = true, .v_is_periodic = true, .is_convex = true};
        candela::sdk::tessellate_surface<candela::sdk::NoParams, position, derivative, derivative>(
            {}, k_topology, 24, 12, {.uv = request.uv}, sink);
    }
};
constexpr candela::Property k_properties[] = {{"closed"}};
}  // namespace

CANDELA_PLUGIN(shape, ConvexRing, candela::sdk::k_no_fields,
               {.title = "Convex ring", .summary = "Bad on purpose.", .properties = k_properties})
