// Reads one past its last index without using the value.
#include "candela/shape_plugin.h"

#include <algorithm>
#include <array>

namespace {
class Tetrahedron final : public candela::Shape {
  public:
    explicit Tetrahedron(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        constexpr std::array<std::uint32_t, 12> k_corners{0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
        const candela::MeshSpans mesh = sink.allocate({.vertices = 4, .triangles = k_corners.size() / 3});
        mesh.position.set(1, {1, 0, 0});
        mesh.position.set(2, {0, 1, 0});
        mesh.position.set(3, {0, 0, 1});
        std::ranges::copy(k_corners, mesh.indices.begin());
        [[maybe_unused]] const volatile std::uint32_t next = *(mesh.indices.data() + k_corners.size());
    }
};
constexpr candela::Property k_properties[] = {{"closed"}};
}  // namespace

CANDELA_PLUGIN(shape, Tetrahedron, candela::sdk::k_no_fields,
               {.title = "Tetrahedron", .summary = "Bad on purpose.", .properties = k_properties})
