// Shared by the faulty shapes: a tetrahedron without fault, to be spoiled.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "candela/shape_plugin.h"

namespace faulty {

constexpr candela::Property k_closed[] = {{"closed"}};

class Tetrahedron : public candela::Shape {
  public:
    explicit Tetrahedron(const candela::sdk::NoParams&) {}
    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        const std::vector<std::uint32_t> indices = corners();
        const candela::MeshSpans mesh = sink.allocate({.vertices = 4, .triangles = indices.size() / 3});
        mesh.position.set(1, {1, 0, 0});
        mesh.position.set(2, {0, 1, 0});
        mesh.position.set(3, {0, 0, 1});
        std::ranges::copy(indices, mesh.indices.begin());
        look_at(mesh);
    }

  protected:
    virtual std::vector<std::uint32_t> corners() const { return {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}; }
    virtual void look_at(const candela::MeshSpans&) const {}
};

}  // namespace faulty

#define FAULTY_SHAPE(Model)                                 \
    CANDELA_PLUGIN(shape, Model, candela::sdk::k_no_fields, \
                   {.title = #Model, .summary = "Bad on purpose.", .properties = faulty::k_closed})
