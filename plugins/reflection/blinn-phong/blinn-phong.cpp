#include "candela/material_presets.h"
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "blinn-phong.kernel"
}

using candela::kernel::BlinnPhongMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(ambient_coefficient(&BlinnPhongMaterial::ka), diffuse_coefficient(&BlinnPhongMaterial::kd),
           specular_coefficient(&BlinnPhongMaterial::ks), shininess(&BlinnPhongMaterial::shininess));

constexpr candela::Property k_properties[] = {{"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    blinn_phong, BlinnPhongMaterial, k_fields,
    {.title = "Blinn-Phong",
     .summary = "A matt surface with a highlight where the normal is close to the half vector of light and "
                "observer.",
     .formula = "H = (L + V) / |L + V|\n"
                "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L max(N.L, 0)\n"
                "I_s = ks I_L max(N.H, 0)^shininess  where N.L > 0, else 0",
     .reference =
         "Blinn (1977), Models of light reflection for computer synthesized pictures, SIGGRAPH, 192-198",
     .relations = k_diffuse_and_specular,
     .properties = k_properties,
     .presets = k_classic_presets})
