// A tetrahedron that declares itself closed, but lacks a face.
#include "candela/shape_plugin.h"

#include <algorithm>
#include <array>

namespace {
class Tetrahedron final : public candela::Shape {
  public:
    explicit Tetrahedron(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        constexpr std::array<std::uint32_t, 9> k_corners{0, 1, 2, 0, 3, 1, 0, 2, 3};
        const candela::MeshSpans mesh = sink.allocate({.vertices = 4, .triangles = k_corners.size() / 3});
        mesh.position.set(1, {1, 0, 0});
        mesh.position.set(2, {0, 1, 0});
        mesh.position.set(3, {0, 0, 1});
        std::ranges::copy(k_corners, mesh.indices.begin());
    }
};
constexpr candela::Property k_properties[] = {{"closed"}};
}  // namespace

CANDELA_PLUGIN(shape, Tetrahedron, candela::sdk::k_no_fields,
               {.title = "Tetrahedron", .summary = "Bad on purpose.", .properties = k_properties})
