#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "derivative.kernel"
}

using namespace candela::sdk;

using Derivative =
    KernelShading<NoParams, candela::ShadingRate::fragment, &candela::kernel::derivative_normal,
                  candela::ShadingNeeds{.barycentric = false, .derivatives = true}>;

CANDELA_KERNEL_PLUGIN(shading, Derivative, derivative, NoParams, k_no_fields,
                      {.title = "Partial derivatives",
                       .summary = "Lit at every pixel with the true normal of the surface where the shape "
                                  "knows its derivatives; facets show elsewhere.",
                       .formula = "N = (dp/du x dp/dv) / |dp/du x dp/dv|",
                       .reference = "Blinn (1978), Simulation of wrinkled surfaces, SIGGRAPH, 286-292"})
