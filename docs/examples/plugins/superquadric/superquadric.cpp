#include <candela/shape_plugin.h>

namespace candela::kernel {
#include "superquadric.kernel"
}

using candela::kernel::SuperquadricShape;
using namespace candela::sdk;

constexpr Topology k_topology{.u_is_periodic = true, .v_ends_in_poles = true};

constexpr auto k_fields =
    fields(real(&SuperquadricShape::width, "width", 1, "along x").above(0).unit("m"),
           real(&SuperquadricShape::height, "height", 1, "along y").above(0).unit("m"),
           real(&SuperquadricShape::depth, "depth", 1, "along z").above(0).unit("m"),
           real(&SuperquadricShape::roundness_polar, "roundness_polar", 0.5f,
                "seen from the side: near 0 a square, 1 round, 2 a rhombus")
               .range(0.2f, 2),
           real(&SuperquadricShape::roundness_around, "roundness_around", 0.5f,
                "seen from above: near 0 a square, 1 round, 2 a rhombus")
               .range(0.2f, 2),
           segments(&SuperquadricShape::segments, 96, "faces around; half as many from pole to pole"));

constexpr candela::Property k_properties[] = {{"closed"},
                                              {"euler-characteristic", "2"},
                                              {"parametric"},
                                              {"bounding-box", "-0.5 -0.5 -0.5 0.5 0.5 0.5"}};

CANDELA_PARAMETRIC_SHAPE_PLUGIN(
    superquadric, SuperquadricShape, k_topology, k_fields,
    {.title = "Superellipsoid",
     .summary = "All shapes between a box, a ball, a cylinder and an octahedron.",
     .formula = "((x/a)^(2/e2) + (z/c)^(2/e2))^(e2/e1) + (y/b)^(2/e1) = 1",
     .reference = "Barr (1981), Superquadrics and angle-preserving transformations, IEEE CG&A 1(1)",
     .properties = k_properties})
