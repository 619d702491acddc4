#include <candela/shading_plugin.h>

namespace candela::kernel {
#include "pn-normals.kernel"
}

using namespace candela::sdk;

CANDELA_SHADING_PLUGIN(
    pn_normals, fragment, NoParams, k_no_fields,
    {.title = "PN normals",
     .summary = "Normals that vary quadratically over a triangle, so that inflections between vertices show.",
     .formula = "N = N_1 b_1^2 + N_2 b_2^2 + N_3 b_3^2 + N_12 b_1 b_2 + N_23 b_2 b_3 + N_31 b_3 b_1, "
                "normalised; N_ij = N_i + N_j mirrored at the plane perpendicular to P_j - P_i, normalised",
     .reference = "Vlachos, Peters, Boyd, Mitchell (2001), Curved PN triangles, Symposium on Interactive 3D "
                  "Graphics"})
