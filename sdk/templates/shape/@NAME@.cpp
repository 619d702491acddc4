#include <candela/shape_plugin.h>

namespace candela::kernel {
#include "@NAME@.kernel"
}

using candela::kernel::@TYPE@Shape;
using namespace candela::sdk;

constexpr Topology k_topology{.u_is_periodic = true, .v_ends_in_poles = true};

constexpr auto k_fields = fields(real(&@TYPE@Shape::width, "width", 1, "across").above(0).unit("m"),
                                 real(&@TYPE@Shape::height, "height", 1.4f, "from pole to pole").above(0).unit("m"),
                                 segments(&@TYPE@Shape::segments, 64, "faces around; half as many from pole to pole"));

// The conformance kit verifies everything declared here.
constexpr candela::Property k_properties[] = {
    {"closed"}, {"euler-characteristic", "2"}, {"parametric"}, {"bounding-box", "-0.5 -0.7 -0.5 0.5 0.7 0.5"}};

CANDELA_PARAMETRIC_SHAPE_PLUGIN(@IDENT@, @TYPE@Shape, k_topology, k_fields,
                                {.title = "@TITLE@",
                                 .summary = "One sentence about it.",
                                 .formula = "p(u, v) = …",
                                 .properties = k_properties})
