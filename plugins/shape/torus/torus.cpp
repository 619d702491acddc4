#include "candela/shape_plugin.h"

namespace candela::kernel {
#include "torus.kernel"
}

using candela::kernel::TorusShape;
using namespace candela::sdk;

namespace {

constexpr Topology k_topology{.u_is_periodic = true, .v_is_periodic = true};

constexpr auto k_fields =
    fields(real(&TorusShape::major_radius, "major_radius", 0.5f,
                "distance from the centre to the middle of the tube")
               .above(0)
               .unit("m"),
           real(&TorusShape::minor_radius, "minor_radius", 0.2f, "radius of the tube").above(0).unit("m"),
           segments(&TorusShape::segments, 64, "faces around the ring; half as many around the tube"));

constexpr candela::RelationSpec k_relations[] = {
    {candela::RelationType::less, "minor_radius", "major_radius", false, "the tube would run into itself"}};
constexpr candela::Property k_properties[] = {{"closed"}, {"euler-characteristic", "0"}, {"parametric"}};

}  // namespace

CANDELA_PARAMETRIC_SHAPE_PLUGIN(
    torus, TorusShape, k_topology, k_fields,
    {.title = "Torus",
     .summary = "A ring lying flat, centred on the object's position.",
     .formula = "p(u, v) = ((R + r cos(2 pi v)) sin(2 pi u), r sin(2 pi v), (R + r cos(2 pi v)) cos(2 pi u))",
     .relations = k_relations,
     .properties = k_properties})
