#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "toon.kernel"
}

using candela::kernel::ToonMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    ambient_coefficient(&ToonMaterial::ka), diffuse_coefficient(&ToonMaterial::kd),
    specular_coefficient(&ToonMaterial::ks),
    integer(&ToonMaterial::bands, "bands", 2, "steps of brightness between dark and light").range(1, 16),
    real(&ToonMaterial::highlight, "highlight", 10,
         "the half vector's largest angle from N within the highlight")
        .range(0, 90)
        .unit("deg"));

constexpr candela::Property k_properties[] = {{"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    toon, ToonMaterial, k_fields,
    {.title = "Toon",
     .summary = "Brightness in steps and a highlight with a hard edge, as in cartoons.",
     .formula = "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L ceil(bands max(N.L, 0)) / bands\n"
                "I_s = ks I_L  where N.L > 0 and N.H > cos(highlight), else 0",
     .reference =
         "Lake, Marshall, Harris, Blackstein (2000), Stylized rendering techniques for scalable real-time 3D "
         "animation, NPAR, 13-20",
     .properties = k_properties})
