// A lamp with the manufacturer's measurements: EULUMDAT (Stockmar 1990). The file becomes a table for the
// kernel.
#include <candela/light_plugin.h>

namespace candela::kernel {
#include "eulumdat.kernel"
}

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

using candela::kernel::EulumdatLight;
using namespace candela::sdk;

namespace {

/// A file of one value a line, in a fixed order.
class Lines {
  public:
    explicit Lines(const char* path) : file_(path) {}

    float number() {
        std::string line;
        ++line_;
        float value = 0;
        if (!std::getline(file_, line) || !(std::istringstream(line) >> value) || !std::isfinite(value))
            throw std::runtime_error("line " + std::to_string(line_) +
                                     " is not a number: it is not an EULUMDAT file");
        return value;
    }
    std::size_t count(float least, float most) {
        const float value = number();
        if (!(value >= least && value <= most))
            throw std::runtime_error("line " + std::to_string(line_) +
                                     " has too large or small a number of values");
        return static_cast<std::size_t>(value);
    }
    void skip(std::size_t lines) {
        std::string line;
        for (std::size_t i = 0; i < lines; ++i, ++line_) std::getline(file_, line);
    }

  private:
    std::ifstream file_;
    std::size_t line_ = 0;
};

/// A grid of candela, as expected by the kernel: a row for each C plane from 0 to 360 degrees.
std::vector<float> table_of(const char* path) {
    Lines lines(path);
    lines.skip(2);  // manufacturer, kind
    const std::size_t symmetry = lines.count(0, 4), planes = lines.count(1, 720);
    const float plane_step = lines.number();
    const std::size_t angles = lines.count(1, 721);
    const float angle_step = lines.number();
    if (!(angle_step > 0) || (symmetry != 1 && !(plane_step > 0)))
        throw std::runtime_error("its angles are not at equal steps");
    if (symmetry == 3)
        throw std::runtime_error("it is symmetric about the plane of C 90, which this plugin does not know");
    lines.skip(14 + 2);  // names, date, size; share of light below, efficiency
    const float factor = lines.number();
    lines.skip(1);  // tilt
    const std::size_t sets = lines.count(1, 20);
    lines.skip(2 * sets);  // numbers and kinds of lamps
    const float lumens = lines.number();
    lines.skip(4 * sets - 1 + 10);  // the rest about lamps, and direct ratios
    lines.skip(planes + angles);    // the angles
    // Measured planes: all, one, a half and both of its ends, or a quarter and both.
    const std::size_t parts[] = {1, 0, 2, 2, 4};
    const std::size_t measured = symmetry == 0 ? planes : symmetry == 1 ? 1 : planes / parts[symmetry] + 1;
    std::vector<float> candela(measured * angles);  // per 1000 lm in the file
    for (float& value : candela) value = std::max(lines.number(), 0.0f) * factor * lumens / 1000;

    const std::size_t turns = symmetry == 1 ? 0 : planes;
    std::vector<float> table{static_cast<float>(angles), angle_step * static_cast<float>(angles - 1),
                             static_cast<float>(turns + 1)};
    for (std::size_t row = 0; row <= turns; ++row) {
        std::size_t plane = row == turns ? 0 : row;
        if (symmetry == 2 || symmetry == 4) plane = std::min(plane, planes - plane);
        if (symmetry == 4) plane = std::min(plane, planes / 2 - plane);
        const auto first = candela.begin() + static_cast<std::ptrdiff_t>(plane * angles);
        table.insert(table.end(), first, first + static_cast<std::ptrdiff_t>(angles));
    }
    return table;
}

constexpr auto k_fields = fields(
    color(&EulumdatLight::color, "color", vec3(255.0f), "colour of the light"),
    real(&EulumdatLight::intensity, "intensity", 0.001f, "the intensity of one candela in the file")
        .minimum(0),
    point(&EulumdatLight::position, "position", "the lamp's position"),
    direction(&EulumdatLight::direction, "direction", "the lamp's axis, at which the angle gamma is 0"),
    file_table(&EulumdatLight::file, "file", table_of, "the lamp's photometry (.ldt)"));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_KERNEL_PLUGIN(
    light, (KernelLight<EulumdatLight, &candela::kernel::eulumdat_illuminate>), eulumdat, EulumdatLight,
    k_fields,
    {.title = "EULUMDAT light",
     .summary = "A lamp with the manufacturer's measurements, from a photometric file.",
     .formula = "I_L = color intensity I(gamma, C) / r^2",
     .reference =
         "Stockmar (1990), EULUMDAT, ein Leuchtendatenformat für den europäischen Beleuchtungsplaner",
     .properties = k_properties})
