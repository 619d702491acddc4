#include "candela/shading_plugin.h"

namespace candela::kernel {
#include "flat.kernel"
}

using namespace candela::sdk;

CANDELA_SHADING_PLUGIN_NEEDING(
    k_face_normal, flat, face, NoParams, k_no_fields,
    {.title = "Flat",
     .summary = "One normal and one colour per triangle, lit at its centroid: facets show.",
     .formula = "N = (P x Q) / |P x Q|  for two edges P, Q of the triangle",
     .reference = "Bouknight (1970), A procedure for generation of three-dimensional half-toned "
                  "computer graphics presentations, CACM 13(9), 527-536"})
