#include "candela/light_plugin.h"

namespace candela::kernel {
#include "hemisphere.kernel"
}

using candela::kernel::HemisphereLight;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(
    color(&HemisphereLight::sky_color, "sky_color", vec3(255.0f), "received by surfaces facing up"),
    color(&HemisphereLight::ground_color, "ground_color", vec3(0.0f), "received by surfaces facing down"),
    light_intensity(&HemisphereLight::intensity, "intensity, the same everywhere"),
    three(&HemisphereLight::up, candela::ParamType::direction, "up", vec3(0.0f, 1.0f, 0.0f),
          "direction towards the sky"));

}  // namespace

CANDELA_AMBIENT_LIGHT_PLUGIN(
    hemisphere, HemisphereLight, k_fields,
    {.title = "Hemisphere light",
     .summary = "Ambient light of one colour from the sky and another from the ground, as outdoors.",
     .formula = "I_ambient = intensity (w sky_color + (1 - w) ground_color),  w = 1/2 + N.up / 2",
     .reference = "Microsoft DirectX SDK, HLSL workshop, Hemispheric lighting"})
