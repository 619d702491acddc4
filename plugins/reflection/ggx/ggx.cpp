#include "candela/material_presets.h"
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "ggx.kernel"
}

using candela::kernel::GgxMaterial;
using namespace candela::sdk;

namespace {

constexpr const char* k_fresnels[] = {"exact", "schlick"};

constexpr auto k_fields = fields(
    ambient_coefficient(&GgxMaterial::ka), diffuse_coefficient(&GgxMaterial::kd),
    specular_coefficient(&GgxMaterial::ks),
    real(&GgxMaterial::roughness, "roughness", 0.2f, "alpha, the width of the highlight").range(0.02f, 1),
    real(&GgxMaterial::ior, "ior", 1.5f, "index of refraction: 1.5 for plastic; 10 reflects like metal")
        .range(1, 100),
    choice(&GgxMaterial::fresnel, "fresnel", k_fresnels, "Fresnel's equations or Schlick's approximation"));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    ggx, GgxMaterial, k_fields,
    {.title = "GGX",
     .summary = "A rough surface of small mirrors whose highlight has a bright core and a wide glow.",
     .formula = "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L max(N.L, 0)\n"
                "I_s = ks I_L F D G / (4 N.V),  D = alpha^2 / (N.H^2 (alpha^2 - 1) + 1)^2\n"
                "G = 2 N.L N.V / (N.L sqrt(alpha^2 + (1 - alpha^2) N.V^2) + N.V sqrt(alpha^2 + (1 - alpha^2) "
                "N.L^2))",
     .reference =
         "Walter, Marschner, Li, Torrance (2007), Microfacet models for refraction through rough surfaces, "
         "EGSR, 195-206; Heitz (2014), Understanding the masking-shadowing function, JCGT 3(2); Schlick "
         "(1994), An inexpensive BRDF model for physically-based rendering, Eurographics",
     .relations = k_diffuse_and_specular,
     .properties = k_properties,
     .presets = k_metal_presets})
