#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "prepared.kernel"
}

using candela::kernel::PreparedMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(diffuse_coefficient(&PreparedMaterial::kd),
           angle(&PreparedMaterial::turn, "turn", 30, "about the z axis").range(0, 180),
           integer(&PreparedMaterial::order, "order", 3, "terms of a sum").range(1, 20));
constexpr candela::Property k_properties[] = {{"fixed-in-world"}};

CANDELA_REFLECTION_PLUGIN(prepared, PreparedMaterial, k_fields,
                          {.title = "Prepared",
                           .summary = "Constants that are computed from the parameters once.",
                           .formula = "(see its kernel)",
                           .properties = k_properties})
