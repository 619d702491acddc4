#include "candela/shape_plugin.h"

namespace candela::kernel {
#include "sphere.kernel"
}

using candela::kernel::SphereShape;
using namespace candela::sdk;

namespace {

class Sphere final : public candela::Shape {
  public:
    explicit Sphere(const SphereShape& shape) : shape_(shape) {}

    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        const auto around = static_cast<std::size_t>(shape_.segments);
        tessellate_surface<SphereShape, candela::kernel::sphere_position, candela::kernel::sphere_dpdu,
                           candela::kernel::sphere_dpdv>(shape_,
                                                         {.u_is_periodic = true, .v_ends_in_poles = true},
                                                         around, std::max<std::size_t>(around / 2, 2), sink);
    }

  private:
    SphereShape shape_;
};

constexpr auto k_fields =
    fields(real(&SphereShape::radius, "radius", 0.5f, "radius").above(0).unit("m"),
           segments(&SphereShape::segments, 64, "faces around the equator; half as many from pole to pole"));

constexpr candela::Property k_properties[] = {{"closed"}, {"euler-characteristic", "2"}, {"parametric"}};

}  // namespace

CANDELA_PLUGIN(shape, Sphere, k_fields,
               {.title = "Sphere",
                .summary = "A sphere about the object's position, poles up and down.",
                .formula = "p(u, v) = radius (sin(pi v) sin(2 pi u), -cos(pi v), sin(pi v) cos(2 pi u))",
                .properties = k_properties})
