#include <numbers>
#include <vector>

#include "candela/light_plugin.h"
#include "photometry.h"

namespace candela::kernel {
#include "ies.kernel"
}

using candela::kernel::IesLight;
using namespace candela::sdk;

namespace {

/// Without a file, light/point of the same intensity.
std::vector<float> table_of_file(const char* path) {
    constexpr auto k_even = static_cast<float>(std::numbers::pi);
    if (*path == '\0')
        return candela::ies_light::table_of(
            {.vertical = {0, 180}, .horizontal = {0}, .candela = {k_even, k_even}});
    return candela::ies_light::table_of(candela::ies_light::read_photometry(path));
}

constexpr auto k_fields = fields(
    file_table(&IesLight::file, "file", table_of_file,
               "the lamp's photometry (.ies, LM-63, type C); without one, it sends pi candela everywhere")
        .made_without_file(),
    color(&IesLight::color, "color", vec3(255.0f), "colour of the light"),
    real(&IesLight::intensity, "intensity", 1, "multiplies the file's candela").minimum(0),
    point(&IesLight::position, "position", "where the lamp is"),
    direction(&IesLight::direction, "direction",
              "the lamp's axis, at which the vertical angle is 0: mostly down"),
    angle(&IesLight::rotation, "rotation", 0, "turns the lamp about its axis"));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_KERNEL_PLUGIN(
    light, (KernelLight<IesLight, &candela::kernel::ies_illuminate, &candela::kernel::ies_distance>), ies,
    IesLight, k_fields,
    {.title = "IES light",
     .summary = "A lamp with its manufacturer's measurements, from a photometric file.",
     .formula = "I_L = color intensity file(v, h) / (pi r^2)\n"
                "v: the angle from the axis, h: around it",
     .reference =
         "ANSI/IES LM-63-19, Approved method: IES standard file format for the electronic transfer of "
         "photometric data",
     .properties = k_properties})
