// Compares light through real meshes with the optics of perfect shapes.
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>
#include <vector>

#include "support/compiled.h"
#include "support/plugins.h"
#include "support/samples.h"

namespace {

std::vector<float> rendered(const candela::RenderScene& scene) {
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real,
                       candela::ColorEncoding::none);
    candela::render(scene, film, {.threads = 2});
    return {film.view().reals.begin(), film.view().reals.end()};
}

constexpr const char* k_ball = R"(version = 1
[observer]
position = [0, 0, 4]
look_at = [0, 0, 0]
projection = "orthographic"
height = 2.2
[image]
width = 110
height = 110
background = [255, 255, 255]
color_management = "none"
[shading]
model = "phong"
[reflection]
model = "dielectric"
[[object]]
type = "sphere"
radius = 1
segments = 256
color = [255, 255, 255]
)";

/// A picture whose red, green and blue are a direction's components along +x, +y and +z, mapped to 0 to 1.
candela::EnvironmentMap compass() {
    constexpr int k_width = 1024, k_height = 512;
    std::vector<float> intensity;
    for (int row = 0; row < k_height; ++row) {
        for (int column = 0; column < k_width; ++column) {
            const double longitude = 2 * std::numbers::pi * ((column + 0.5) / k_width - 0.5);
            const double polar = std::numbers::pi * (row + 0.5) / k_height;
            for (const double part : {std::sin(polar) * std::sin(longitude), std::cos(polar),
                                      -std::sin(polar) * std::cos(longitude)})
                intensity.push_back(static_cast<float>(0.5 + 0.5 * part));
        }
    }
    return {k_width, k_height, intensity};
}

}  // namespace

TEST_CASE("a glass ball shows the world upside down, by Snell's law and Fresnel's equations") {
    candela::RenderScene scene =
        compiled(std::string(k_ball) + "[object.material]\ninternal_reflections = 0\n").scene;
    scene.environment = compass();
    const std::vector<float> picture = rendered(scene);
    // Along the middle row the path stays in the plane y = 0, with two refractions that each turn it by
    // theta_1 - theta_2.
    int compared = 0;
    for (int column = 0; column < 110; ++column) {
        const double x = (column + 0.5 - 55) * 0.02;
        if (std::abs(x) > 0.97) continue;
        const double incident = std::asin(x), refracted = std::asin(x / 1.5);
        const double f =
            incident == 0 ? 0.04
                          : (std::pow(std::sin(incident - refracted) / std::sin(incident + refracted), 2) +
                             std::pow(std::tan(incident - refracted) / std::tan(incident + refracted), 2)) /
                                2;
        // The line of sight, (0, 0, -1), turned towards the axis; and mirrored.
        const double turned = 2 * (incident - refracted), mirrored = 2 * incident;
        const double through[] = {-std::sin(turned), 0, -std::cos(turned)};
        const double mirror[] = {std::sin(mirrored), 0, std::cos(mirrored)};
        // Pixel centres are half a pixel, 0.01, off that plane.
        const std::size_t first = 3 * (std::size_t{55} * 110 + static_cast<std::size_t>(column));
        INFO("x = " << x);
        for (std::size_t c = 0; c < 3; ++c) {
            const double expected = f * (0.5 + 0.5 * mirror[c]) + (1 - f) * (0.5 + 0.5 * through[c]);
            CHECK(std::abs(static_cast<double>(picture[first + c]) - expected) < 0.012);
        }
        ++compared;
    }
    CHECK(compared > 90);
}

TEST_CASE("transparent objects of any shape are invisible in surroundings of one intensity") {
    for (const char* const shape : {"sphere", "cube", "torus", "teapot"}) {
        for (const char* const shading : {"flat", "gouraud", "phong"}) {
            INFO(shape << ", " << shading);
            std::string text = k_ball;
            const std::size_t type = text.find("type = ");
            text.replace(type, text.find("color = ") - type,
                         "type = \"" + std::string(shape) + "\"\nrotation = [30, 40, 0]\n");
            text.replace(text.find("model = \"phong\""), 15, "model = \"" + std::string(shading) + "\"");
            for (const float x : rendered(compiled(text).scene)) {
                if (std::abs(x - 1) > 2e-4f) FAIL("a channel is " << x);
            }
        }
    }
}

TEST_CASE("an environment is the background of a perspective picture, each pixel in its direction") {
    std::string text = k_ball;
    text.resize(text.find("[[object]]"));
    text.replace(text.find("projection"), std::string("projection = \"orthographic\"\nheight = 2.2").size(),
                 "fov = 90");
    candela::RenderScene scene = compiled(text).scene;
    scene.environment = compass();
    const std::vector<float> picture = rendered(scene);
    for (const auto& [column, row] : {std::pair{0, 0}, {109, 0}, {55, 55}, {17, 93}}) {
        const Double3 towards = unit({(column + 0.5) / 55 - 1, 1 - (row + 0.5) / 55, -1});
        const std::size_t first =
            3 * (static_cast<std::size_t>(row) * 110 + static_cast<std::size_t>(column));
        INFO("column " << column << ", row " << row);
        CHECK(std::abs(picture[first] - (0.5 + 0.5 * towards.x)) < 1e-3);
        CHECK(std::abs(picture[first + 1] - (0.5 + 0.5 * towards.y)) < 1e-3);
        CHECK(std::abs(picture[first + 2] - (0.5 + 0.5 * towards.z)) < 1e-3);
    }
}
