#include "candela/light_plugin.h"

namespace candela::kernel {
#include "spot.kernel"

PunctualLight punctual(const SpotLight& light, int) {
    PunctualLight result = sdk::punctual_source(light.position, light.color, light.intensity,
                                                light.attenuation, light.attenuation_offset);
    result.has_cone = true;
    result.is_smooth = light.falloff == 0;
    result.axis = {light.direction.x, light.direction.y, light.direction.z};
    result.cos_outer = cos(light.outer_angle);
    result.cone_scale = 1.0f / max(cos(light.inner_angle) - result.cos_outer, 1.0e-7f);
    return result;
}
}  // namespace candela::kernel

using candela::kernel::SpotLight;
using namespace candela::sdk;

namespace {

constexpr const char* k_falloffs[] = {"smoothstep", "linear"};

constexpr auto k_fields =
    fields(light_color(&SpotLight::color),
           light_intensity(&SpotLight::intensity, "intensity at one metre, before attenuation"),
           point(&SpotLight::position, "position", "where the light is"),
           direction(&SpotLight::direction, "direction",
                     "the axis of the cone, in the direction in which the light travels"),
           angle(&SpotLight::inner_angle, "inner_angle", 15, "half-angle of the cone of full light")
               .minimum(0)
               .below(90),
           angle(&SpotLight::outer_angle, "outer_angle", 25, "half-angle beyond which there is no light")
               .minimum(0)
               .below(90),
           choice(&SpotLight::falloff, "falloff", k_falloffs,
                  "how the light fades between the two cones, as a function of the cosine"),
           attenuation(&SpotLight::attenuation), attenuation_offset(&SpotLight::attenuation_offset));

constexpr candela::RelationSpec k_relations[] = {{candela::RelationType::less_or_equal, "inner_angle",
                                                  "outer_angle", false,
                                                  "the cone of full light lies within the cone of light"}};
constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_LIGHT_PLUGIN(
    spot, SpotLight, k_fields,
    {.title = "Spot light",
     .summary = "A point light that shines into a cone, like a theatre lamp.",
     .formula = "L = (position - p) / r,  r = |position - p|\n"
                "t = clamp((-L.direction - cos outer) / (cos inner - cos outer), 0, 1)\n"
                "I_L = color intensity attenuation(r) t^2 (3 - 2 t)    falloff = \"smoothstep\"\n"
                "I_L = color intensity attenuation(r) t                falloff = \"linear\"",
     .reference = "Shreiner, Angel (2012), Interactive computer graphics, 6th edition",
     .relations = k_relations,
     .properties = k_properties})
