#include <algorithm>
#include <cstddef>
#include <memory>
#include <span>
#include <vector>

#include "candela/light_plugin.h"
#include "candela/picture.h"
#include "median_cut.h"

namespace candela::kernel {
#include "environment.kernel"

PunctualLight punctual(const EnvironmentLight& light, int index) {
    return sdk::distant_light(environment_illuminate(light, Receiver(), index));
}
}  // namespace candela::kernel

using candela::kernel::EnvironmentLight;
using namespace candela::sdk;

namespace {

using candela::Picture;

/// White in all directions, if no picture is named.
std::shared_ptr<const Picture> picture_of(const char* path) {
    if (path != nullptr && *path != '\0') return candela::read_picture(path);
    return std::make_shared<const Picture>(Picture{.width = 1, .height = 1, .intensity = {1, 1, 1}});
}

std::vector<float> samples_of(const char* path) {
    return candela::environment_light::median_cut(*picture_of(path));
}

using Sampled = KernelSampledLight<EnvironmentLight, &candela::kernel::environment_illuminate,
                                   &candela::kernel::environment_sample_count>;

class Environment : public Sampled, public candela::SkySource {
  public:
    explicit Environment(const EnvironmentLight& light, std::span<const candela::ParamValue> values = {})
        : Sampled(light), picture_(picture_of(values.empty() ? nullptr : values[0].text)) {}

    int sky_columns() const noexcept override {
        constexpr int k_most = 8192;
        return std::clamp(std::max(picture_->width, 2 * std::min(picture_->height, k_most)), 2, k_most);
    }

    void see(std::size_t count, const candela::ConstVec3Span& towards,
             const candela::Vec3Span& intensity) const override {
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 in_picture = candela::kernel::environment_turned(load(towards, i), -params().rotation);
            const candela::Vec3 seen =
                candela::environment_light::seen(*picture_, {in_picture.x, in_picture.y, in_picture.z});
            intensity.set(i, params().intensity * seen);
        }
    }

  private:
    std::shared_ptr<const Picture> picture_;
};

constexpr const char* k_sample_choices[] = {"1",  "2",   "4",   "8",   "16",  "32",
                                            "64", "128", "256", "512", "1024"};

constexpr Field<EnvironmentLight> k_samples{
    .spec = {.name = "samples",
             .type = candela::ParamType::integer,
             .meaning = "how many distant lights are chosen from the picture",
             .default_value = {.integer = 64},
             .choices = k_sample_choices},
    .integer = &EnvironmentLight::samples};

constexpr auto k_fields = fields(
    file_table(&EnvironmentLight::picture, "picture", samples_of,
               "an equirectangular picture, its centre towards -z; without one, white light comes from "
               "everywhere")
        .made_without_file(),
    real(&EnvironmentLight::intensity, "intensity", 1, "multiplies the picture").minimum(0),
    angle(&EnvironmentLight::rotation, "rotation", 0,
          "turns the picture about the vertical axis, counter-clockwise seen from above"),
    k_samples);

constexpr candela::Property k_properties[] = {{"attenuation", "constant"}};

}  // namespace

CANDELA_KERNEL_PLUGIN(
    light, Environment, environment, EnvironmentLight, k_fields,
    {.title = "Environment",
     .summary = "Light from everywhere, as a panorama or an HDR picture of the surroundings shows it.",
     .formula = "I_L(i) = intensity / pi * the integral of the picture over region i\n"
                "regions: the picture, halved again and again so that both halves send the same",
     .reference = "Debevec (2005), A median cut algorithm for light probe sampling, SIGGRAPH posters",
     .properties = k_properties})
