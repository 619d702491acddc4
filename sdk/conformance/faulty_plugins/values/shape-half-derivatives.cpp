// A square whose dp/du has the right direction but half the length.
#include <algorithm>
#include <array>

#include "candela/shape_plugin.h"

namespace {
class HalfDerivatives final : public candela::Shape {
  public:
    explicit HalfDerivatives(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest& request, candela::MeshSink& sink) const override {
        constexpr std::array<std::uint32_t, 6> k_corners{0, 1, 2, 0, 2, 3};
        const candela::MeshSpans mesh = sink.allocate(
            {.vertices = 4, .triangles = 2, .has_uv = request.uv, .has_derivatives = request.derivatives});
        for (std::size_t i = 0; i < 4; ++i) {
            const float u = i == 1 || i == 2 ? 1.0f : 0.0f, v = i > 1 ? 1.0f : 0.0f;
            mesh.position.set(i, {2 * u, 3 * v, 0});
            if (request.uv) mesh.uv.x[i] = u, mesh.uv.y[i] = v;
            if (!request.derivatives) continue;
            mesh.dpdu.set(i, {1, 0, 0});
            mesh.dpdv.set(i, {0, 3, 0});
        }
        std::ranges::copy(k_corners, mesh.indices.begin());
    }
};
constexpr candela::Property k_properties[] = {{"open"}};
}  // namespace

CANDELA_PLUGIN(shape, HalfDerivatives, candela::sdk::k_no_fields,
               {.title = "Half derivatives", .summary = "Bad on purpose.", .properties = k_properties})
