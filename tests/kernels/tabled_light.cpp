#include <candela/light_plugin.h>

namespace candela::kernel {
#include "tabled_light.kernel"
}

using candela::kernel::TabledLightLight;
using namespace candela::sdk;

constexpr float k_profile[] = {2.0f, 1.5f, 0.6f, 0.2f};

constexpr auto k_fields =
    fields(point(&TabledLightLight::position, "position", "where it is"),
           matrix(&TabledLightLight::mixing, "mixing", "of the colour's channels").range(-1, 1),
           numbers(&TabledLightLight::profile, "profile", k_profile, "intensity by distance").range(0, 4),
           real(&TabledLightLight::reach, "reach", 8, "the distance of the profile's end").above(0).unit("m"),
           light_color(&TabledLightLight::color));

CANDELA_LIGHT_PLUGIN(tabled_light, TabledLightLight, k_fields,
                     {.title = "Tabled",
                      .summary = "A light whose intensity by distance is a table.",
                      .formula = "(see its kernel)"})
