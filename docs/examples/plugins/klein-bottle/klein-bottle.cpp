#include <candela/shape_plugin.h>

namespace candela::kernel {
#include "klein-bottle.kernel"
}

using candela::kernel::KleinBottleShape;
using namespace candela::sdk;

// After one turn the figure of eight is upside down: u = 1 joins u = 0 only with v reversed and the sides
// swapped.
constexpr Topology k_topology{.v_is_periodic = true};

constexpr auto k_fields = fields(
    real(&KleinBottleShape::radius, "radius", 0.5f, "the radius of the path around the axis")
        .above(0)
        .unit("m"),
    real(&KleinBottleShape::thickness, "thickness", 0.4f, "the size of the figure of eight")
        .above(0)
        .unit("m"),
    segments(&KleinBottleShape::segments, 128, "faces around; half as many along the figure of eight"));

constexpr candela::RelationSpec k_relations[] = {{candela::RelationType::less, "thickness", "radius", false,
                                                  "the figure of eight would reach over the axis"}};
constexpr candela::Property k_properties[] = {{"open"}, {"parametric"}};

CANDELA_PARAMETRIC_SHAPE_PLUGIN(
    klein_bottle, KleinBottleShape, k_topology, k_fields,
    {.title = "Klein bottle",
     .summary = "A surface with one side, which passes through itself.",
     .formula = "d = cos(pi u) sin(2 pi v) - sin(pi u) sin(4 pi v)\n"
                "h = sin(pi u) sin(2 pi v) + cos(pi u) sin(4 pi v)\n"
                "p(u, v) = ((R + t/2 d) sin(2 pi u), t/2 h, (R + t/2 d) cos(2 pi u))",
     .reference = "Apery (1987), Models of the real projective plane, Vieweg",
     .relations = k_relations,
     .properties = k_properties})
