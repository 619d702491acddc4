#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "sheen.kernel"
}

using candela::kernel::SheenMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(ambient_coefficient(&SheenMaterial::ka), diffuse_coefficient(&SheenMaterial::kd),
           specular_coefficient(&SheenMaterial::ks),
           real(&SheenMaterial::roughness, "roughness", 0.5f,
                "the fibres' roughness: small values glow only at the very rim")
               .range(0.1f, 1));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"isotropic"}};

CANDELA_REFLECTION_PLUGIN(
    sheen, SheenMaterial, k_fields,
    {.title = "Sheen",
     .summary = "Velvet and other cloth, brightest at grazing angles.",
     .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L N.L\n"
                "D = (2 + 1/r) sin(N, H)^(1/r) / (2 pi)\n"
                "I_s = ks I_L pi D N.L / (4 (N.L + N.V - N.L N.V))",
     .reference = "Estevez, Kulla (2017), Production friendly microfacet sheen BRDF, SIGGRAPH talks",
     .properties = k_properties})
