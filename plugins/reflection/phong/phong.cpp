#include "candela/material_presets.h"
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "phong.kernel"
}

using candela::kernel::PhongMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(ambient_coefficient(&PhongMaterial::ka), diffuse_coefficient(&PhongMaterial::kd),
           specular_coefficient(&PhongMaterial::ks), shininess(&PhongMaterial::shininess));

constexpr candela::Property k_properties[] = {{"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    phong, PhongMaterial, k_fields,
    {.title = "Phong",
     .summary =
         "A matt surface with a highlight around the direction in which a mirror would reflect the light.",
     .formula = "R = 2 N (N.L) - L\n"
                "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L max(N.L, 0)\n"
                "I_s = ks I_L max(R.V, 0)^shininess  where N.L > 0, else 0",
     .reference = "Phong (1975), Illumination for computer generated pictures, CACM 18(6), 311-317",
     .relations = k_diffuse_and_specular,
     .properties = k_properties,
     .presets = k_classic_presets})
