#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "lambert.kernel"
}

using candela::kernel::LambertMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(ambient_coefficient(&LambertMaterial::ka), diffuse_coefficient(&LambertMaterial::kd));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    lambert, LambertMaterial, k_fields,
    {.title = "Lambert",
     .summary = "A matt surface: bright where it faces the light, and equally bright from every direction.",
     .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L max(N.L, 0)",
     .reference = "Lambert (1760), Photometria",
     .properties = k_properties})
