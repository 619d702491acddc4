#include "candela/light_plugin.h"

namespace candela::kernel {
#include "point.kernel"

PunctualLight punctual(const PointLight& light, int) {
    return sdk::punctual_source(light.position, light.color, light.intensity, light.attenuation,
                                light.attenuation_offset);
}
}  // namespace candela::kernel

using candela::kernel::PointLight;
using namespace candela::sdk;

namespace {

constexpr auto k_fields =
    fields(light_color(&PointLight::color),
           light_intensity(&PointLight::intensity, "intensity at one metre, before attenuation"),
           point(&PointLight::position, "position", "where the light is"),
           attenuation(&PointLight::attenuation), attenuation_offset(&PointLight::attenuation_offset));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_LIGHT_PLUGIN(point, PointLight, k_fields,
                     {.title = "Point light",
                      .summary = "Light from one point, equal in every direction, like a bare bulb.",
                      .formula = "L = (position - p) / r,  r = |position - p|\n"
                                 "I_L = color intensity / r^2        attenuation = \"inverse-square\"\n"
                                 "I_L = color intensity / (r + k)    attenuation = \"offset-linear\"\n"
                                 "I_L = color intensity              attenuation = \"none\"",
                      .reference = "Shreiner, Angel (2012), Interactive computer graphics, 6th edition",
                      .properties = k_properties})
