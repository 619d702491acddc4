#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "gooch.kernel"
}

using candela::kernel::GoochMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    diffuse_coefficient(&GoochMaterial::kd), specular_coefficient(&GoochMaterial::ks),
    shininess(&GoochMaterial::shininess),
    color(&GoochMaterial::cool, "cool", vec3(0, 0, 140), "tone of surfaces that face away from the light"),
    color(&GoochMaterial::warm, "warm", vec3(80, 80, 0), "tone of surfaces that face the light"),
    real(&GoochMaterial::alpha, "alpha", 0.2f, "how much of the object's colour goes into the cool tone")
        .range(0, 1),
    real(&GoochMaterial::beta, "beta", 0.6f, "how much of the object's colour goes into the warm tone")
        .range(0, 1));

constexpr candela::Property k_properties[] = {{"isotropic"}, {"lights-below-horizon"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    gooch, GoochMaterial, k_fields,
    {.title = "Gooch",
     .summary =
         "Shades from cool to warm colours instead of from dark to light, as in technical illustrations.",
     .formula = "I_d = I_L ((1 + N.L) / 2 k_warm + (1 - N.L) / 2 k_cool)\n"
                "k_cool = cool + alpha kd C_o,  k_warm = warm + beta kd C_o\n"
                "I_s = ks I_L max(R.V, 0)^shininess  where N.L > 0, else 0",
     .reference =
         "Gooch, Gooch, Shirley, Cohen (1998), A non-photorealistic lighting model for automatic technical "
         "illustration, SIGGRAPH, 447-452",
     .properties = k_properties})
