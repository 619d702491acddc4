#include "candela/material_presets.h"
#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "cook-torrance.kernel"
}

using candela::kernel::CookTorranceMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    ambient_coefficient(&CookTorranceMaterial::ka), diffuse_coefficient(&CookTorranceMaterial::kd),
    specular_coefficient(&CookTorranceMaterial::ks),
    real(&CookTorranceMaterial::roughness, "roughness", 0.2f, "m, the root mean square slope of the facets")
        .range(0.05f, 1),
    real(&CookTorranceMaterial::ior, "ior", 1.5f,
         "index of refraction: 1.5 for plastic; 10 reflects like metal")
        .range(1, 100));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(cook_torrance, CookTorranceMaterial, k_fields,
                          {.title = "Cook-Torrance",
                           .summary = "A rough surface of small mirrors that shadow one another, brightest "
                                      "at grazing angles: plastic, metal.",
                           .formula = "I_a = ka C_o I_ambient\n"
                                      "I_d = kd C_o I_L max(N.L, 0)\n"
                                      "I_s = ks I_L F D G / (4 N.V),  D = exp(-tan(alpha)^2 / m^2) / (m^2 "
                                      "cos(alpha)^4),  cos(alpha) = N.H\n"
                                      "G = min(1, 2 N.H N.V / V.H, 2 N.H N.L / V.H)",
                           .reference = "Cook, Torrance (1982), A reflectance model for computer graphics, "
                                        "ACM Transactions on Graphics 1(1), "
                                        "7-24",
                           .relations = k_diffuse_and_specular,
                           .properties = k_properties,
                           .presets = k_metal_presets})
