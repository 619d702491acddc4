#include "candela/light_plugin.h"

namespace candela::kernel {
#include "directional.kernel"

PunctualLight punctual(const DirectionalLight& light, int) {
    PunctualLight result = sdk::punctual_source(-light.direction, light.color, light.intensity, 2, 0.0f);
    result.w = 0;
    return result;
}
}  // namespace candela::kernel

using candela::kernel::DirectionalLight;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(light_color(&DirectionalLight::color),
           light_intensity(&DirectionalLight::intensity, "intensity, the same everywhere"),
           direction(&DirectionalLight::direction, "direction", "the direction in which the light travels"));

constexpr candela::Property k_properties[] = {{"attenuation", "constant"}};

}  // namespace

CANDELA_LIGHT_PLUGIN(directional, DirectionalLight, k_fields,
                     {.title = "Directional light",
                      .summary = "Light from infinitely far away, like the sun's.",
                      .formula = "L = -direction\nI_L = color intensity",
                      .reference = "Shreiner, Angel (2012), Interactive computer graphics, 6th edition",
                      .properties = k_properties})
