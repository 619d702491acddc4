#include <candela/light_plugin.h>

namespace candela::kernel {
#include "prepared_light.kernel"
}

using candela::kernel::PreparedLightLight;
using namespace candela::sdk;

constexpr auto k_fields =
    fields(point(&PreparedLightLight::position, "position", "where it is"),
           light_intensity(&PreparedLightLight::intensity, "at one metre"),
           real(&PreparedLightLight::warmth, "warmth", 0.5f, "0 white, 1 warm").range(0, 1));
constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

CANDELA_LIGHT_PLUGIN(prepared_light, PreparedLightLight, k_fields,
                     {.title = "Prepared",
                      .summary = "A light whose colour is computed from its temperature once.",
                      .formula = "(see its kernel)",
                      .properties = k_properties})
