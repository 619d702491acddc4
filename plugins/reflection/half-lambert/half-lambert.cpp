#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "half-lambert.kernel"
}

using candela::kernel::HalfLambertMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    ambient_coefficient(&HalfLambertMaterial::ka), diffuse_coefficient(&HalfLambertMaterial::kd),
    real(&HalfLambertMaterial::exponent, "exponent", 2, "n: 2 is the published model, 1 omits the square")
        .minimum(0));

constexpr candela::Property k_properties[] = {{"isotropic"}, {"lights-below-horizon"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    half_lambert, HalfLambertMaterial, k_fields,
    {.title = "Half Lambert",
     .summary = "A soft matt surface whose light wraps around to the side that faces away.",
     .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L (N.L / 2 + 1/2)^n",
     .reference = "Mitchell, McTaggart, Green (2006), Shading in Valve's Source engine, "
                  "SIGGRAPH course notes",
     .properties = k_properties})
