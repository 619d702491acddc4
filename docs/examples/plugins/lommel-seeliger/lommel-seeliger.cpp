#include <candela/reflection_plugin.h>

namespace candela::kernel {
#include "lommel-seeliger.kernel"
}

using candela::kernel::LommelSeeligerMaterial;
using namespace candela::sdk;

constexpr auto k_fields = fields(ambient_coefficient(&LommelSeeligerMaterial::ka),
                                 coefficient(&LommelSeeligerMaterial::albedo, "albedo", 0.9f,
                                             "the share of light that a single grain scatters"));

constexpr candela::Property k_properties[] = {{"reciprocal"}, {"energy-bounded"}, {"isotropic"}};

CANDELA_REFLECTION_PLUGIN(
    lommel_seeliger, LommelSeeligerMaterial, k_fields,
    {.title = "Lommel-Seeliger",
     .summary = "Dark dust, as on the moon and on asteroids: a full disc is equally bright up to its rim.",
     .formula = "I_a = ka C_o I_ambient\nI_d = w C_o I_L N.L / (4 (N.L + N.V))",
     .reference = "Hapke (2012), Theory of reflectance and emittance spectroscopy, 2nd edition, eq. 8.35a",
     .properties = k_properties})
