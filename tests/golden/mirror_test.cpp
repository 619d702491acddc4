// The mirror image of light from everywhere, against closed forms and integrals of the rendering equation.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "golden/image.h"
#include "support/command.h"
#include "support/samples.h"

using candela::Vec3;

namespace {

constexpr int k_size = 60;
constexpr double k_metres = 2.1;

using Sky = std::function<Double3(Double3 towards)>;

/// A dim sky and a bright window.
Double3 indoors(Double3 d) {
    const double sky = 0.3 + 0.2 * d.y;
    const Double3 window = unit({0.4, 0.55, 0.75});
    const double bright = dot(d, window) > 0.93 ? 9 : 0;
    return {sky + bright, 0.9 * sky + bright, 1.1 * sky + 0.8 * bright};
}

/// Another colour from every side, without edges.
Double3 smooth(Double3 d) { return {0.5 + 0.4 * d.x, 0.5 + 0.4 * d.y, 0.5 + 0.4 * d.z}; }

/// Writes a portable float map of the sky.
void write_sky(const std::filesystem::path& file, const Sky& sky) {
    constexpr int k_width = 1024, k_height = 512;
    std::ofstream out(file, std::ios::binary);
    out << "PF\n" << k_width << ' ' << k_height << "\n-1.0\n";
    for (int row = k_height - 1; row >= 0; --row) {
        for (int column = 0; column < k_width; ++column) {
            const double longitude = 2 * M_PI * ((column + 0.5) / k_width - 0.5),
                         polar = M_PI * (row + 0.5) / k_height;
            const Double3 rgb = sky({std::sin(polar) * std::sin(longitude), std::cos(polar),
                                     -std::sin(polar) * std::cos(longitude)});
            const float pixel[] = {static_cast<float>(rgb.x), static_cast<float>(rgb.y),
                                   static_cast<float>(rgb.z)};
            out.write(reinterpret_cast<const char*>(pixel), sizeof pixel);
        }
    }
}

/// A metal sphere that reflects all light at normal incidence, seen along -z.
std::string scene(const std::string& light, const std::string& material,
                  const std::string& reflection = "metallic-roughness") {
    return fmt::format(
        "[observer]\nposition = [0, 0, 5]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = {0}\n"
        "[image]\nwidth = {1}\nheight = {1}\ncolor_management = \"none\"\nsamples = 1\n"
        "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"{2}\"\n"
        "[[light]]\nname = \"sky\"\ntype = \"environment\"\n{3}\n"
        "[[object]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 1\nsegments = 256\n"
        "color = [255, 255, 255]\n[object.material]\nka = 0\n{4}\n",
        k_metres, k_size, reflection, light, material);
}

Image rendered(const Sky& sky, const std::string& light, const std::string& material,
               const std::vector<std::string>& arguments = {}) {
    const auto folder = scratch_directory();
    write_sky(folder / "sky.pfm", sky);
    return render_floats(folder, scene("picture = \"sky.pfm\"\n" + light, material), arguments);
}

template <class Check>
void each_pixel(const Image& image, Check check) {
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x) {
            const Double3 at = orthographic_point(image, x, y, k_metres);
            const double square = at.x * at.x + at.y * at.y;
            if (square > 0.9) continue;  // near the outline, the mesh is not the sphere
            check(Double3{at.x, at.y, std::sqrt(1 - square)}, exact(image.at(x, y)));
        }
    }
}

/// The light that a GGX surface of reflectance 1 reflects towards +z from a sky, with height-correlated
/// masking: the integral over its facets, at equal steps of their distribution.
Double3 reflected(const Sky& sky, Double3 n, double alpha, int steps) {
    const Double3 t = unit(cross(n, std::abs(n.x) < 0.7 ? Double3{1, 0, 0} : Double3{0, 1, 0}));
    const Double3 b = cross(n, t), v{0, 0, 1};
    const auto lambda = [&](double cosine) {
        return 0.5 * (std::sqrt(1 + alpha * alpha * (1 / (cosine * cosine) - 1)) - 1);
    };
    Double3 sum;
    for (int i = 0; i < steps; ++i) {
        const double share = (i + 0.5) / steps, slope = alpha * std::sqrt(share / (1 - share));
        const double cosine = 1 / std::sqrt(1 + slope * slope);
        for (int k = 0; k < steps; ++k) {
            const double angle = 2 * M_PI * (k + 0.5) / steps;
            const Double3 h = cosine * (n + slope * (std::cos(angle) * t + std::sin(angle) * b));
            const double v_dot_h = dot(v, h);
            const Double3 l = 2 * v_dot_h * h - v;
            const double n_dot_l = dot(n, l), n_dot_v = dot(n, v);
            if (n_dot_l <= 0 || v_dot_h <= 0) continue;
            const double seen = 1 / (1 + lambda(n_dot_v) + lambda(n_dot_l));
            sum = sum + (seen * v_dot_h / (n_dot_v * cosine * steps * steps)) * sky(l);
        }
    }
    return sum;
}

/// The mean difference of a picture from what a sky's integral says, over the mean of that.
double mean_error(const Image& image, const Sky& sky, double alpha, int steps) {
    double error = 0, mean = 0;
    each_pixel(image, [&](Double3 n, Double3 actual) {
        const Double3 expected = reflected(sky, n, alpha, steps);
        const Double3 apart = actual - expected;
        error += std::abs(apart.x) + std::abs(apart.y) + std::abs(apart.z);
        mean += expected.x + expected.y + expected.z;
    });
    return error / mean;
}

const std::string k_metal = "metallic = 1\nroughness = ";

}  // namespace

TEST_CASE(
    "golden: under a white sky, a perfect metal reflects what its facets do not hide, whatever its "
    "roughness") {
    for (const double roughness : {0.0, 0.05, 0.2, 0.4, 0.6, 1.0}) {
        INFO("roughness " << roughness);
        const double alpha = std::max(roughness * roughness, 0.001);
        const Image image = render_floats(scratch_directory(),
                                          scene("samples = 256", k_metal + fmt::format("{}", roughness)));
        const Sky white = [](Double3) { return Double3{1, 1, 1}; };
        CHECK(mean_error(image, white, alpha, 100) < 0.006);
        each_pixel(image, [&](Double3 n, Double3 actual) {
            REQUIRE(std::abs(actual.x - reflected(white, n, alpha, 60).x) < 0.05);
        });
    }
}

TEST_CASE("golden: without roughness, a metal shows its surroundings as a mirror does") {
    each_pixel(rendered(smooth, "", k_metal + "0"), [](Double3 n, Double3 actual) {
        const Double3 expected = smooth(2 * n.z * n - Double3{0, 0, 1});
        REQUIRE(length(actual - expected) < 0.01);
    });
}

TEST_CASE("golden: the mirror image turns with the light, and is as bright as its intensity says") {
    const auto turned = [](Double3 d) {  // by 90 degrees, counter-clockwise seen from above
        return 2 * smooth({-d.z, d.y, d.x});
    };
    each_pixel(rendered(smooth, "rotation = 90\nintensity = 2", k_metal + "0.1"),
               [&](Double3 n, Double3 actual) {
                   const Double3 expected = turned(2 * n.z * n - Double3{0, 0, 1});
                   REQUIRE(length(actual - expected) < 0.04);
               });
}

TEST_CASE("golden: a metal shows a bright window blurred by its roughness") {
    for (const auto& [roughness, most] : {std::pair{0.1, 0.015}, {0.3, 0.025}, {0.5, 0.015}, {0.7, 0.015}}) {
        const Image image = rendered(indoors, "", k_metal + fmt::format("{}", roughness));
        const double error = mean_error(image, indoors, roughness * roughness, 120);
        INFO("roughness " << roughness << ": " << error);
        CHECK(error < most);
    }
}

TEST_CASE("golden: diffuse light is that of the samples, whether or not there is a mirror image") {
    const auto diffuse = [](const std::string& reflection, const std::string& material) {
        const auto folder = scratch_directory();
        write_sky(folder / "sky.pfm", indoors);
        return render_floats(folder, scene("picture = \"sky.pfm\"", material, reflection));
    };
    // GGX's diffuse part is Lambert's.
    const Image lambert = diffuse("lambert", "kd = 0.5"),
                ggx = diffuse("ggx", "kd = 0.5\nks = 0\nroughness = 0.1");
    REQUIRE(lambert.rgb.size() == ggx.rgb.size());
    for (std::size_t i = 0; i < ggx.rgb.size(); ++i) REQUIRE(std::abs(lambert.rgb[i] - ggx.rgb[i]) < 1e-4f);
}

TEST_CASE("golden: the occlusion of a material dims the mirror image as it dims ambient light") {
    const Image open = rendered(smooth, "", k_metal + "0"),
                half = rendered(smooth, "", k_metal + "0\nocclusion = 0.5");
    for (std::size_t i = 0; i < open.rgb.size(); ++i)
        REQUIRE(std::abs(half.rgb[i] - 0.5f * open.rgb[i]) < 5e-3f);
}
