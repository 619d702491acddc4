#include "candela/light_plugin.h"

namespace candela::kernel {
#include "distributed.kernel"

PunctualLight punctual(const DistributedLight& light, int sample) {
    const float share = light.intensity / static_cast<float>(distributed_sample_count(light));
    return sdk::punctual_source(distributed_position(light, sample), light.color, share, light.attenuation,
                                light.attenuation_offset);
}
}  // namespace candela::kernel

using candela::kernel::DistributedLight;
using namespace candela::sdk;

namespace {

constexpr float k_longest = 1000;

constexpr auto k_fields = fields(
    light_color(&DistributedLight::color),
    light_intensity(&DistributedLight::intensity, "total intensity at one metre, before attenuation")
        .maximum(1e20f),
    point(&DistributedLight::position, "position", "the centre of the line or rectangle"),
    three(&DistributedLight::edge_u, candela::ParamType::vector, "edge_u", vec3(1.0f, 0.0f, 0.0f),
          "one edge of the rectangle, or the line, from end to end")
        .range(-k_longest, k_longest)
        .unit("m"),
    three(&DistributedLight::edge_v, candela::ParamType::vector, "edge_v", vec3(0.0f),
          "the other edge of the rectangle; zero for a line")
        .range(-k_longest, k_longest)
        .unit("m"),
    integer(&DistributedLight::samples_u, "samples_u", 8, "point lights along edge_u").range(1, 64),
    integer(&DistributedLight::samples_v, "samples_v", 1, "point lights along edge_v").range(1, 64),
    attenuation(&DistributedLight::attenuation), attenuation_offset(&DistributedLight::attenuation_offset));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_SAMPLED_LIGHT_PLUGIN(
    distributed, DistributedLight, k_fields,
    {.title = "Distributed light",
     .summary = "A luminous line or rectangle, like a tube or a panel, made of many point lights.",
     .formula = "p_ij = position + ((i + 1/2) / n_u - 1/2) edge_u + ((j + 1/2) / n_v - 1/2) edge_v\n"
                "each a point light of intensity / (n_u n_v),  n_u = samples_u, n_v = samples_v",
     .reference = "O'Reilly, Rendering equation, lecture notes, Dundalk Institute of Technology",
     .properties = k_properties})
