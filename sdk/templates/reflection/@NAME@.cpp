#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "@NAME@.kernel"
}

using candela::kernel::@TYPE@Material;
using namespace candela::sdk;

constexpr auto k_fields = fields(ambient_coefficient(&@TYPE@Material::ka), diffuse_coefficient(&@TYPE@Material::kd));

// The conformance kit verifies everything declared here.
constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

CANDELA_REFLECTION_PLUGIN(@IDENT@, @TYPE@Material, k_fields,
                          {.title = "@TITLE@",
                           .summary = "One sentence about it.",
                           .formula = "I_a = ka C_o I_ambient\nI_d = kd C_o I_L max(N.L, 0)",
                           .reference = "Author (year), Title",
                           .properties = k_properties})
