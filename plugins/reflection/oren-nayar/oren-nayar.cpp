#include "candela/reflection_plugin.h"

namespace candela::kernel {
#include "oren-nayar.kernel"
}

using candela::kernel::OrenNayarMaterial;
using namespace candela::sdk;

namespace {

constexpr const char* k_forms[] = {"full", "qualitative", "fujii"};

// Closer to 1 the published formulas reflect more light than they receive: the full form 5 %, Fujii's 3 %,
// the qualitative form 1.5 %.
constexpr float k_largest_kd = 0.95f;

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
     .summary = "A rough matt surface that looks flatter than Lambert's and brighter towards the light: "
                "plaster, clay, the moon.",
     .formula = "I_a = ka C_o I_ambient\n"
                "I_d = kd C_o I_L max(N.L, 0) f,  s2 = sigma^2\n"
                "full: f = C1 + cos(dphi) C2 tan(beta) + (1 - |cos(dphi)|) C3 tan((alpha + beta) / 2)\n"
                "          + 0.17 kd C_o s2 / (s2 + 0.13) (1 - cos(dphi) (2 beta / pi)^2),  at least 0\n"
                "C1 = 1 - 0.5 s2 / (s2 + 0.33)\n"
                "C2 = 0.45 s2 / (s2 + 0.09) (sin(alpha) - (cos(dphi) < 0 ? (2 beta / pi)^3 : 0))\n"
                "C3 = 0.125 s2 / (s2 + 0.09) (4 alpha beta / pi^2)^2\n"
                "qualitative: f = A + B max(cos(dphi), 0) sin(alpha) tan(beta)\n"
                "A = C1,  B = 0.45 s2 / (s2 + 0.09)\n"
                "fujii: f = A + B s / (s > 0 ? max(N.L, N.V) : 1) + 0.17 kd C_o s2 / (s2 + 0.13)\n"
                "s = L.V - N.L N.V\n"
                "alpha, beta: the larger and the smaller angle of light and observer from N; dphi: between "
                "their planes",
     .reference = "Oren, Nayar (1994), Generalization of Lambert's reflectance model, SIGGRAPH, 239-246; "
                  "Fujii (2012), A tiny improvement of Oren-Nayar reflectance model",
     .properties = k_properties})
