// Float pictures, rendered by the command.
#pragma once

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/samples.h"

struct Image {
    int width = 0;
    int height = 0;
    std::vector<float> rgb;

    candela::Vec3 at(int x, int y) const {
        const auto i = 3 * static_cast<std::size_t>(y * width + x);
        return {rgb[i], rgb[i + 1], rgb[i + 2]};
    }
};

/// Writes `scene` (TOML without its version) into `directory`, renders it to a PFM file with the command, and
/// reads that.
Image render_floats(const std::filesystem::path& directory, const std::string& scene,
                    const std::vector<std::string>& arguments = {});

/// The centre of a pixel in an orthographic view along -z from (0, 0, distance), y up, `metres` fitting the
/// height.
Double3 orthographic_point(const Image& image, int x, int y, double metres);

/// The unit direction of a pixel's ray in a perspective view along -z, y up.
Double3 perspective_ray(const Image& image, int x, int y, double fov_degrees);

/// Requires every pixel to be what `expected(x, y)`, three numbers, says.
template <class Expected>
void require_pixels(const Image& image, Expected expected, double tolerance = 2e-6) {
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::array<double, 3> at = expected(x, y);
            const auto pixel = image.at(x, y);
            INFO("pixel " << x << ", " << y << ": " << pixel.x << ' ' << pixel.y << ' ' << pixel.z
                          << " instead of " << at[0] << ' ' << at[1] << ' ' << at[2]);
            REQUIRE(std::abs(static_cast<double>(pixel.x) - at[0]) < tolerance);
            REQUIRE(std::abs(static_cast<double>(pixel.y) - at[1]) < tolerance);
            REQUIRE(std::abs(static_cast<double>(pixel.z) - at[2]) < tolerance);
        }
    }
}
