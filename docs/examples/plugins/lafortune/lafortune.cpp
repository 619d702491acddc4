#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "lafortune.kernel"
}

using candela::kernel::LafortuneMaterial;
using namespace candela::sdk;

constexpr auto k_fields = fields(
    ambient_coefficient(&LafortuneMaterial::ka), diffuse_coefficient(&LafortuneMaterial::kd),
    specular_coefficient(&LafortuneMaterial::ks),
    real(&LafortuneMaterial::c_xy, "c_xy", -1, "-1 mirrors, 1 reflects back to the light").range(-1, 1),
    real(&LafortuneMaterial::c_z, "c_z", 1,
         "below |c_xy| the lobe leans to the horizon, above it to the normal")
        .range(-1, 1),
    real(&LafortuneMaterial::exponent, "exponent", 20, "the larger, the narrower the lobe is")
        .range(1, 1000));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"isotropic"}};

CANDELA_REFLECTION_PLUGIN(
    lafortune, LafortuneMaterial, k_fields,
    {.title = "Lafortune's lobe",
     .summary = "A generalised cosine lobe: off-specular, mirroring or retroreflecting.",
     .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L N.L\n"
                "I_s = ks I_L (n + 2) / 2 max(c_xy (L.V - N.L N.V) + c_z N.L N.V, 0)^n N.L",
     .reference = "Lafortune, Foo, Torrance, Greenberg (1997), Non-linear approximation of reflectance "
                  "functions, SIGGRAPH",
     .properties = k_properties})
