#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "area-weighted.kernel"
}

using namespace candela::sdk;

CANDELA_WEIGHTED_SHADING_PLUGIN(
    k_vertex_normal, area_weighted, fragment, NoParams, k_no_fields,
    {.title = "Phong, faces weighted by area",
     .summary = "Phong shading with vertex normals that follow the larger faces.",
     .formula = "N_v = sum A_i n_i / |sum A_i n_i|  with A_i the area of face i\n"
                "N = (b_1 N_1 + b_2 N_2 + b_3 N_3) / |...|  with barycentric b",
     .reference = "Max (1999), Weights for computing vertex normals from facet normals, Journal of Graphics "
                  "Tools 4(2), 1-6"})
