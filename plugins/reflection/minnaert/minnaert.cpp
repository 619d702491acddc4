#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "minnaert.kernel"
}

using candela::kernel::MinnaertMaterial;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(ambient_coefficient(&MinnaertMaterial::ka), diffuse_coefficient(&MinnaertMaterial::kd),
           real(&MinnaertMaterial::k, "k", 0.8f,
                "1 is Lambert's law; smaller is brighter towards the rim, larger darker")
               .range(0.5f, 4));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    minnaert, MinnaertMaterial, k_fields,
    {.title = "Minnaert",
     .summary = "A matt surface that is darker or brighter towards the rim: the moon, velvet.",
     .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L max(N.L, 0)^k (N.V)^(k - 1)",
     .reference =
         "Minnaert (1941), The reciprocity principle in lunar photometry, Astrophysical Journal 93, 403-410",
     .properties = k_properties})
