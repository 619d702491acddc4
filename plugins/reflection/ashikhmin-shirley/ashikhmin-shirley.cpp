#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "ashikhmin-shirley.kernel"
}

using candela::kernel::AshikhminShirleyMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    ambient_coefficient(&AshikhminShirleyMaterial::ka), diffuse_coefficient(&AshikhminShirleyMaterial::kd),
    coefficient(&AshikhminShirleyMaterial::ks, "ks", 0.1f, "R_s: reflectance at normal incidence"),
    real(&AshikhminShirleyMaterial::exponent_u, "exponent_u", 10,
         "the larger, the narrower the highlight along u")
        .range(0, 10000),
    real(&AshikhminShirleyMaterial::exponent_v, "exponent_v", 100,
         "the larger, the narrower the highlight across u")
        .range(0, 10000));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}};

}  // namespace

CANDELA_ANISOTROPIC_REFLECTION_PLUGIN(
    ashikhmin_shirley, AshikhminShirleyMaterial, k_fields,
    {.title = "Ashikhmin-Shirley",
     .summary = "An anisotropic Phong highlight with Fresnel gloss at grazing angles, over a diffuse part "
                "that yields to it.",
     .formula = "I_a = ka C_o I_ambient\n"
                "I_d = 28/23 kd C_o (1 - ks) I_L (1 - (1 - N.L / 2)^5) (1 - (1 - N.V / 2)^5) N.L\n"
                "I_s = I_L sqrt((n_u + 1)(n_v + 1)) / 8 (N.H)^(n_u cos(phi)^2 + n_v sin(phi)^2) F N.L / (V.H "
                "max(N.L, N.V))\n"
                "F = ks + (1 - ks)(1 - V.H)^5",
     .reference =
         "Ashikhmin, Shirley (2000), An anisotropic Phong BRDF model, Journal of Graphics Tools 5(2), 25-32",
     .properties = k_properties})
