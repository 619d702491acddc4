#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "angle-weighted.kernel"
}

using namespace candela::sdk;

CANDELA_WEIGHTED_SHADING_PLUGIN(
    k_vertex_normal, angle_weighted, fragment, NoParams, k_no_fields,
    {.title = "Phong, faces weighted by angle",
     .summary = "Phong shading with vertex normals that do not depend on how flat faces are cut into "
                "triangles.",
     .formula = "N_v = sum a_i n_i / |sum a_i n_i|  with a_i the angle of face i at the vertex\n"
                "N = (b_1 N_1 + b_2 N_2 + b_3 N_3) / |...|  with barycentric b",
     .reference = "Thuermer, Wuethrich (1998), Computing vertex normals from polygonal facets, Journal of "
                  "Graphics Tools 3(1), 43-46"})
