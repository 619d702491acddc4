#include <candela/shading_plugin.h>

namespace candela::kernel {
#include "@NAME@.kernel"
}

using namespace candela::sdk;

// Light is evaluated once per face, vertex or fragment.
CANDELA_SHADING_PLUGIN(@IDENT@, fragment, NoParams, k_no_fields,
                       {.title = "@TITLE@",
                        .summary = "One sentence about it.",
                        .formula = "N = (N_face + N_vertex) / |N_face + N_vertex|",
                        .reference = "Author (year), Title"})
