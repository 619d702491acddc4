#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "oren-nayar.kernel"
}

using candela::kernel::OrenNayarMaterial;
using namespace candela::sdk;

namespace {

constexpr const char* k_forms[] = {"full", "qualitative", "fujii"};

// Nearer to 1 the published formulas send out up to 4 % more light than they receive.
constexpr float k_largest_kd = 0.96f;

constexpr auto k_fields =
    fields(ambient_coefficient(&OrenNayarMaterial::ka),
           diffuse_coefficient(&OrenNayarMaterial::kd).range(0, k_largest_kd),
           real(&OrenNayarMaterial::sigma, "sigma", 25,
                "roughness: how much the slopes of the surface's facets vary")
               .range(0, 90)
               .unit("deg"),
           choice(&OrenNayarMaterial::form, "form", k_forms,
                  "the paper's full model, its simplification, or Fujii's variant of that"));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

}  // namespace

CANDELA_REFLECTION_PLUGIN(
    oren_nayar, OrenNayarMaterial, k_fields,
    {.title = "Oren-Nayar",
     .summary = "A rough matt surface, flatter than Lambert's and brighter towards the light: plaster, clay, "
                "the moon.",
     .formula =
         "I_a = ka C_o I_ambient\n"
         "I_d = kd C_o I_L max(N.L, 0) (A + B max(cos(dphi), 0) sin(alpha) tan(beta))   (qualitative)\n"
         "A = 1 - sigma^2 / (2 sigma^2 + 0.66),  B = 0.45 sigma^2 / (sigma^2 + 0.09)\n"
         "alpha, beta: the larger and the smaller angle of light and observer from N",
     .reference = "Oren, Nayar (1994), Generalization of Lambert's reflectance model, SIGGRAPH, 239-246; "
                  "Fujii (2012), A tiny improvement of Oren-Nayar reflectance model",
     .properties = k_properties})
