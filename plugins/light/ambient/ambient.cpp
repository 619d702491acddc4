#include "candela/light_plugin.h"

namespace candela::kernel {
#include "ambient.kernel"

vec3 uniform_ambient(const AmbientLight& light) { return light.color * light.intensity; }
}  // namespace candela::kernel

using candela::kernel::AmbientLight;
using namespace candela::sdk;

namespace {

constexpr auto k_fields = fields(light_color(&AmbientLight::color),
                                 light_intensity(&AmbientLight::intensity, "intensity, the same everywhere"));

}  // namespace

CANDELA_AMBIENT_LIGHT_PLUGIN(
    ambient, AmbientLight, k_fields,
    {.title = "Ambient light",
     .summary = "Light from all directions, approximating light reflected by other surfaces.",
     .formula = "I_ambient = color intensity",
     .reference = "Shreiner, Angel (2012), Interactive computer graphics, 6th edition"})
