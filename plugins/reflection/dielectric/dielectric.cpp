#include "candela/refraction_plugin.h"

namespace candela::kernel {
#include "dielectric.kernel"
}

using candela::kernel::DielectricMaterial;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(coefficient(&DielectricMaterial::ks, "ks", 1.0f, "brightness of reflections of lights"),
           real(&DielectricMaterial::shininess, "shininess", 400,
                "the larger, the smaller the reflection of a light")
               .minimum(0),
           real(&DielectricMaterial::ior, "ior", 1.5f,
                "index of refraction: 1.33 for water, 1.5 for glass, 2.42 for diamond")
               .range(1, 4),
           real(&DielectricMaterial::depth, "depth", 1,
                "distance within the object after which white light has its colour")
               .minimum(1e-6f)
               .unit("m"),
           integer(&DielectricMaterial::internal_reflections, "internal_reflections", 4,
                   "maximum number of internal reflections followed")
               .range(0, 16));

CANDELA_REFRACTION_PLUGIN(
    dielectric, DielectricMaterial, k_fields,
    {.title = "Dielectric",
     .summary = "Glass, water, diamond: reflects and refracts the object's surroundings.",
     .formula = "n_1 sin(theta_1) = n_2 sin(theta_2)\n"
                "F = (r_s^2 + r_p^2) / 2,  r_s = (n_1 cos(theta_1) - n_2 cos(theta_2)) / (n_1 cos(theta_1) + "
                "n_2 cos(theta_2)),\n"
                "r_p = (n_2 cos(theta_1) - n_1 cos(theta_2)) / (n_2 cos(theta_1) + n_1 cos(theta_2))\n"
                "I = F environment(mirrored) + (1 - F) C_o^(distance / depth) environment(refracted) + "
                "ks F I_L max(N.H, 0)^shininess",
     .reference =
         "Born, Wolf (1999), Principles of optics, 7th edition, section 1.5: Snell's and Fresnel's laws"})
