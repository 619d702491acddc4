// A lamp with the manufacturer's measurements: IES LM-63 (ANSI/IES LM-63-19), photometry of type C. The file
// becomes a table for the kernel.
#include <candela/light_plugin.h>

namespace candela::kernel {
#include "ies.kernel"
}

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>
#include <sstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

using candela::kernel::IesLight;
using namespace candela::sdk;

namespace {

/// Candela by vertical angle (0 is along the lamp's axis) for each horizontal angle; both ascending, in
/// degrees.
struct Photometry {
    std::vector<float> vertical, horizontal, candela;

    explicit Photometry(const char* path) {
        std::ifstream file(path);
        std::string line;
        while (std::getline(file, line) && !line.starts_with("TILT=")) {
        }
        if (!line.starts_with("TILT=NONE"))
            throw std::runtime_error("it has no 'TILT=NONE': it is not an IES file, or its lamp is tilted");
        std::string rest{std::istreambuf_iterator<char>(file), {}};
        std::ranges::replace(rest, ',', ' ');
        std::istringstream numbers(rest);
        const auto next = [&] {
            float number = 0;
            if (!(numbers >> number)) throw std::runtime_error("it ends before its last candela value");
            return number;
        };
        const auto list = [&](std::size_t count) {
            std::vector<float> values(count);
            for (float& value : values) value = next();
            return values;
        };
        const std::vector<float> head =
            list(13);  // lamps, lumens, multiplier, counts, type, unit, size, factors
        for (const std::size_t i : {3, 4})
            if (!(head[i] >= 1 && head[i] <= 1000))
                throw std::runtime_error("its number of angles is not from 1 to 1000");
        if (head[5] != 1) throw std::runtime_error("its photometry is not of type C");
        vertical = list(static_cast<std::size_t>(head[3]));
        horizontal = list(static_cast<std::size_t>(head[4]));
        candela = list(vertical.size() * horizontal.size());
        for (float& value : candela) value = std::max(value, 0.0f) * head[2] * head[10];
        for (const auto* angles : {&vertical, &horizontal})
            if (!std::ranges::is_sorted(*angles)) throw std::runtime_error("its angles do not ascend");
    }

    /// The value at an angle, interpolated; 0 outside the measured vertical angles. Missing horizontal angles
    /// follow from symmetry.
    float at(float down, float around) const {
        if (down < vertical.front() || down > vertical.back()) return 0;
        const float last = horizontal.back();
        if (last <= 90 && around > 180) around = 360 - around;
        if (last <= 90 && around > 90) around = 180 - around;
        if (last <= 180 && around > 180) around = 360 - around;
        const auto [v, vt] = between(vertical, down);
        const auto [h, ht] = between(horizontal, around);
        const auto value = [&](std::size_t i, std::size_t j) {
            return candela[std::min(i, horizontal.size() - 1) * vertical.size() +
                           std::min(j, vertical.size() - 1)];
        };
        return std::lerp(std::lerp(value(h, v), value(h, v + 1), vt),
                         std::lerp(value(h + 1, v), value(h + 1, v + 1), vt), ht);
    }

  private:
    static std::pair<std::size_t, float> between(const std::vector<float>& angles, float angle) {
        const auto above = std::ranges::upper_bound(angles, angle);
        if (above == angles.begin()) return {0, 0.0f};
        const auto i = static_cast<std::size_t>(above - angles.begin()) - 1;
        return {i, above == angles.end() ? 0.0f : (angle - angles[i]) / (*above - angles[i])};
    }
};

/// The largest step, in degrees, of which all angles are multiples; at least half a degree.
float step_of(const std::vector<float>& angles) {
    for (const float step : {90.0f, 45.0f, 30.0f, 22.5f, 15.0f, 10.0f, 7.5f, 5.0f, 2.5f, 2.0f, 1.0f}) {
        const auto is_whole = [&](float angle) {
            return std::abs(std::remainder(angle - angles.front(), step)) < 1e-3f;
        };
        if (std::ranges::all_of(angles, is_whole)) return step;
    }
    return 0.5f;
}

/// A grid of equal steps, as expected by the kernel.
std::vector<float> table_of(const char* path) {
    const Photometry photometry(path);
    const float last = photometry.vertical.back();
    // Starting at the axis: the first angle may be greater than 0.
    std::vector<float> downwards = photometry.vertical;
    downwards.insert(downwards.begin(), 0.0f);
    const auto steps = static_cast<int>(std::ceil(last / step_of(downwards)));
    const int turns = photometry.horizontal.size() < 2
                          ? 0
                          : static_cast<int>(std::lround(360 / step_of(photometry.horizontal)));
    std::vector<float> table{static_cast<float>(steps + 1), last, static_cast<float>(turns + 1)};
    for (int row = 0; row <= turns; ++row) {
        const float around = turns == 0 ? 0 : 360.0f * static_cast<float>(row) / static_cast<float>(turns);
        for (int column = 0; column <= steps; ++column)
            table.push_back(
                photometry.at(last * static_cast<float>(column) / static_cast<float>(std::max(steps, 1)),
                              row == turns ? 0 : around));
    }
    return table;
}

constexpr auto k_fields = fields(
    color(&IesLight::color, "color", vec3(255.0f), "colour of the light"),
    real(&IesLight::intensity, "intensity", 0.001f, "the intensity of one candela in the file").minimum(0),
    point(&IesLight::position, "position", "the lamp's position"),
    direction(&IesLight::direction, "direction", "the lamp's axis, at which the vertical angle is 0"),
    file_table(&IesLight::file, "file", table_of, "the lamp's photometry (.ies, LM-63, type C)"));

constexpr candela::Property k_properties[] = {{"attenuation", "by distance"}};

}  // namespace

CANDELA_KERNEL_PLUGIN(
    light, (KernelLight<IesLight, &candela::kernel::ies_illuminate>), ies, IesLight, k_fields,
    {.title = "IES light",
     .summary = "A lamp with the manufacturer's measurements, from a photometric file.",
     .formula = "I_L = color intensity I(vertical, horizontal) / r^2",
     .reference = "ANSI/IES LM-63-19, Approved method: IES standard file format for photometric data",
     .properties = k_properties})
