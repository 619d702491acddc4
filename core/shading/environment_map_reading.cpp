module;

#include <cmath>
#include <cstddef>
#include <filesystem>
#include <numbers>
#include <utility>
#include <vector>

module candela.shading;

import candela.api;
import candela.plugins;
import candela.util;

namespace candela {

EnvironmentMap read_environment(const std::filesystem::path& file, Registry& registry,
                                ColorEncoding encoding) {
    Picture picture = read_intensities(file, registry, encoding);
    return {picture.width, picture.height, std::move(picture.intensity)};
}

EnvironmentMap environment_of(const SkySource& sky) {
    const auto columns = static_cast<std::size_t>(sky.sky_columns()), rows = (columns + 1) / 2;
    require_memory(3 * columns * rows * sizeof(float), "a background that a light provides");
    std::vector<float> intensity(3 * columns * rows);
    constexpr double k_pi = std::numbers::pi;
    parallel_for(rows, 1, [&](std::size_t begin, std::size_t end) {
        Vec3Arrays towards, seen;
        towards.resize(columns);
        seen.resize(columns);
        for (std::size_t row = begin; row < end; ++row) {
            const double down = k_pi * (static_cast<double>(row) + 0.5) / static_cast<double>(rows);
            for (std::size_t column = 0; column < columns; ++column) {
                const double across =
                    2 * k_pi * ((static_cast<double>(column) + 0.5) / static_cast<double>(columns) - 0.5);
                towards.span().set(column, {static_cast<float>(std::sin(down) * std::sin(across)),
                                            static_cast<float>(std::cos(down)),
                                            static_cast<float>(-std::sin(down) * std::cos(across))});
            }
            sky.see(columns, std::as_const(towards).span(), seen.span());
            for (std::size_t column = 0; column < columns; ++column) {
                float* const to = &intensity[3 * (row * columns + column)];
                to[0] = seen.x[column];
                to[1] = seen.y[column];
                to[2] = seen.z[column];
            }
        }
    });
    return {static_cast<int>(columns), static_cast<int>(rows), std::move(intensity)};
}

}  // namespace candela
