#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "toon.kernel"
}

using candela::kernel::ToonMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(ambient_coefficient(&ToonMaterial::ka), diffuse_coefficient(&ToonMaterial::kd),
           integer(&ToonMaterial::bands, "bands", 3, "steps of brightness").range(1, 16));

CANDELA_REFLECTION_PLUGIN(toon, ToonMaterial, k_fields,
                          {.title = "Toon", .summary = "Brightness in steps, as in cartoons."})
