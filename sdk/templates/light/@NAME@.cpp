#include <candela/light_plugin.h>

namespace candela::kernel {
#include "@NAME@.kernel"
}

using candela::kernel::@TYPE@Light;
using namespace candela::sdk;

constexpr auto k_fields = fields(light_color(&@TYPE@Light::color),
                                 light_intensity(&@TYPE@Light::intensity, "intensity at one metre"),
                                 point(&@TYPE@Light::position, "position", "position of the light"));

// The conformance kit verifies everything declared here.
constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

CANDELA_LIGHT_PLUGIN(@IDENT@, @TYPE@Light, k_fields,
                     {.title = "@TITLE@",
                      .summary = "One sentence about it.",
                      .formula = "L = (position - p) / r\nI_L = color intensity / r^2",
                      .properties = k_properties})
