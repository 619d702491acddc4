#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "gouraud.kernel"
}

using namespace candela::sdk;

CANDELA_SHADING_PLUGIN_NEEDING(
    k_vertex_normal, gouraud, vertex, NoParams, k_no_fields,
    {.title = "Gouraud",
     .summary = "Lit at the vertices with their normals; colours are interpolated in between.",
     .formula = "N_v = sum n_i / |sum n_i|  over the faces i that share the vertex\n"
                "I = b_1 I(v_1) + b_2 I(v_2) + b_3 I(v_3)  with barycentric b",
     .reference = "Gouraud (1971), Continuous shading of curved surfaces, IEEE Transactions on "
                  "Computers C-20(6), 623-629"})
