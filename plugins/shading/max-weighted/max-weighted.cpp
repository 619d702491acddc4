#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "max-weighted.kernel"
}

using namespace candela::sdk;

CANDELA_WEIGHTED_SHADING_PLUGIN(
    k_vertex_normal, max_weighted, fragment, NoParams, k_no_fields,
    {.title = "Phong, Max's weights",
     .summary =
         "Phong shading with vertex normals that are exact on a sphere, however it is cut into triangles.",
     .formula = "N_v = sum w_i n_i / |sum w_i n_i|  with w_i = sin a_i / (|P_i| |Q_i|)\n"
                "for the edges P_i, Q_i of face i at the vertex, at angle a_i\n"
                "N = (b_1 N_1 + b_2 N_2 + b_3 N_3) / |...|  with barycentric b",
     .reference = "Max (1999), Weights for computing vertex normals from facet normals, Journal of Graphics "
                  "Tools 4(2), 1-6"})
