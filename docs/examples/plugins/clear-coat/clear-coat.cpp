#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "clear-coat.kernel"
}

using candela::kernel::ClearCoatMaterial;
using namespace candela::sdk;

constexpr auto k_fields = fields(
    ambient_coefficient(&ClearCoatMaterial::ka), diffuse_coefficient(&ClearCoatMaterial::kd),
    real(&ClearCoatMaterial::ior, "ior", 1.5f, "the coat's index of refraction").range(1.01f, 3),
    real(&ClearCoatMaterial::roughness, "roughness", 0.15f, "the coat's roughness: 0 polished, 1 rough")
        .range(0.03f, 1));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

CANDELA_REFLECTION_PLUGIN(
    clear_coat, ClearCoatMaterial, k_fields,
    {.title = "Clear coat",
     .summary = "A matt ground under a clear varnish, as on cars and violins.",
     .formula = "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L (1 - F(N.L)) (1 - F(N.V)) N.L\n"
                "I_s = I_L F(L.H) D(N.H) G / (4 N.V)",
     .reference = "Kelemen, Szirmay-Kalos (2001), A microfacet based coupled specular-matte BRDF model",
     .properties = k_properties})
