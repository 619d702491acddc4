#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "phong.kernel"
}

using namespace candela::sdk;

CANDELA_SHADING_PLUGIN_NEEDING(
    k_vertex_normal, phong, fragment, NoParams, k_no_fields,
    {.title = "Phong",
     .summary = "Lit at every pixel with normals interpolated between the vertices: smooth highlights.",
     .formula = "N_v = sum n_i / |sum n_i|  over the faces i that share the vertex\n"
                "N = (b_1 N_1 + b_2 N_2 + b_3 N_3) / |...|  with barycentric b",
     .reference = "Phong (1975), Illumination for computer generated pictures, CACM 18(6), 311-317"})
