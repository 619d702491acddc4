#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "cel.kernel"
}

using candela::kernel::CelMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(ambient_coefficient(&CelMaterial::ka), diffuse_coefficient(&CelMaterial::kd),
           integer(&CelMaterial::bands, "bands", 3, "steps of brightness").range(1, 16));

CANDELA_REFLECTION_PLUGIN(cel, CelMaterial, k_fields,
                          {.title = "Cel", .summary = "Brightness in steps, as in cartoons."})
