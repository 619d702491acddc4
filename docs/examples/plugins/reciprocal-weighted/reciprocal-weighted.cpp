#include <candela/shading_plugin.h>

namespace candela::kernel {
#include "reciprocal-weighted.kernel"
}

using namespace candela::sdk;

CANDELA_WEIGHTED_SHADING_PLUGIN(
    k_vertex_normal, reciprocal_weighted, fragment, NoParams, k_no_fields,
    {.title = "Reciprocally weighted normals",
     .summary = "Interpolated normals in which the faces with the shortest edges at a vertex count most.",
     .formula = "N_vertex = sum of N_face / (|e_1| |e_2|), normalised",
     .reference = "Max (1999), Weights for computing vertex normals from facet normals, Journal of Graphics "
                  "Tools 4(2)"})
