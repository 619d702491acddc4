#include "candela/shape_plugin.h"

namespace candela::kernel {
#include "sphere.kernel"
}

using candela::kernel::SphereShape;
using namespace candela::sdk;

namespace {

constexpr Topology k_topology{.u_is_periodic = true, .v_ends_in_poles = true, .is_convex = true};

constexpr auto k_fields =
    fields(real(&SphereShape::radius, "radius", 0.5f, "radius").above(0).unit("m"),
           segments(&SphereShape::segments, 64, "faces around the equator; half as many from pole to pole"));

constexpr candela::Property k_properties[] = {{"closed"}, {"euler-characteristic", "2"}, {"parametric"}};

}  // namespace

CANDELA_PARAMETRIC_SHAPE_PLUGIN(
    sphere, SphereShape, k_topology, k_fields,
    {.title = "Sphere",
     .summary = "A sphere centred on the object's position, with its poles at the top and bottom.",
     .formula = "p(u, v) = radius (sin(pi v) sin(2 pi u), -cos(pi v), sin(pi v) cos(2 pi u))",
     .properties = k_properties})
