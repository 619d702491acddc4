#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::PunctualLight;
using candela::Vec3;

namespace {

using Sky = std::function<Double3(Double3 towards)>;

Double3 towards(double column, double row, int width, int height) {
    const double longitude = 2 * M_PI * (column / width - 0.5), polar = M_PI * row / height;
    return {std::sin(polar) * std::sin(longitude), std::cos(polar), -std::sin(polar) * std::cos(longitude)};
}

/// Writes a portable float map of the sky.
std::string picture_of(const Sky& sky, int width, int height) {
    const std::filesystem::path path = scratch_directory() / "sky.pfm";
    std::ofstream file(path, std::ios::binary);
    file << "PF\n" << width << ' ' << height << "\n-1.0\n";
    for (int row = height - 1; row >= 0; --row) {
        for (int column = 0; column < width; ++column) {
            const Double3 rgb = sky(towards(column + 0.5, row + 0.5, width, height));
            const float pixel[] = {static_cast<float>(rgb.x), static_cast<float>(rgb.y),
                                   static_cast<float>(rgb.z)};
            file.write(reinterpret_cast<const char*>(pixel), sizeof pixel);
        }
    }
    return path.string();
}

std::vector<PunctualLight> samples_of(const Light& light) {
    const auto* const data = candela::extension_of<candela::PunctualSource>(light);
    REQUIRE(data != nullptr);
    std::vector<PunctualLight> samples;
    for (int i = 0; i < light.sample_count(); ++i) samples.push_back(data->as_punctual(i));
    return samples;
}

/// The light that a matt white surface reflects: the sum of max(N.L, 0) I.
Double3 reflected(const std::vector<PunctualLight>& samples, Double3 normal) {
    Double3 sum;
    for (const PunctualLight& s : samples) {
        const double cosine = std::max(dot(normal, exact(s.position)), 0.0);
        sum = sum + cosine * Double3{s.diffuse.r, s.diffuse.g, s.diffuse.b};
    }
    return sum;
}

/// The integral of the sky itself times max(N.L, 0), divided by pi, on a grid of its own.
Double3 integral(const Sky& sky, Double3 normal) {
    constexpr int k_columns = 720, k_rows = 360;
    Double3 sum;
    for (int row = 0; row < k_rows; ++row) {
        const double angle =
            2 * M_PI / k_columns * (std::cos(M_PI * row / k_rows) - std::cos(M_PI * (row + 1) / k_rows));
        for (int column = 0; column < k_columns; ++column) {
            const Double3 d = towards(column + 0.5, row + 0.5, k_columns, k_rows);
            sum = sum + (angle * std::max(dot(d, normal), 0.0) / M_PI) * sky(d);
        }
    }
    return sum;
}

double worst_error(const std::vector<PunctualLight>& samples,
                   const std::function<double(Double3)>& expected) {
    double worst = 0;
    Random random(11);
    for (int i = 0; i < 500; ++i) {
        const Double3 normal = exact(random.direction());
        worst = std::max(worst, std::abs(reflected(samples, normal).x / expected(normal) - 1));
    }
    return worst;
}

/// A blue sky, darker ground, and a sun of a few degrees.
Double3 outdoors(Double3 d) {
    const double up = 0.5 + 0.5 * std::tanh(8 * d.y);
    const double sun = dot(d, unit({0.4, 0.6, -0.5})) > 0.997 ? 300 : 0;
    return {0.15 * (1 - up) + 0.4 * up + sun, 0.13 * (1 - up) + 0.6 * up + 0.95 * sun,
            0.1 * (1 - up) + (0.8 + 0.2 * d.x) * up + 0.8 * sun};
}

}  // namespace

TEST_CASE("light/environment without a picture lights a matt surface as a white sky does, in any direction") {
    for (const auto& [samples, most] : {std::pair{64, 0.03}, {256, 0.01}, {1024, 0.004}}) {
        INFO(samples << " samples");
        const auto light = instance<Light>("environment", {{"samples", std::int64_t{samples}}});
        REQUIRE(light->sample_count() == samples);
        CHECK(worst_error(samples_of(*light), [](Double3) { return 1.0; }) < most);
    }
}

TEST_CASE("light/environment sends all light of its picture") {
    const auto light = instance<Light>(
        "environment", {{"picture", picture_of([](Double3) { return Double3{1, 2, 3}; }, 90, 45)},
                        {"intensity", 0.5},
                        {"samples", std::int64_t{16}}});
    Double3 sum;
    for (const PunctualLight& s : samples_of(*light)) {
        CHECK(s.w == 0);
        CHECK(std::abs(length(exact(s.position)) - 1) < 1e-6);
        sum = sum + Double3{s.diffuse.r, s.diffuse.g, s.diffuse.b};
    }
    // 4 pi / pi.
    CHECK(length(sum - Double3{2, 4, 6}) < 1e-4);
}

TEST_CASE("light/environment agrees with the closed form under a sky that brightens towards the zenith") {
    const std::string picture = picture_of(
        [](Double3 d) {
            const double level = 0.5 + 0.5 * d.y;
            return Double3{level, level, level};
        },
        256, 128);
    const auto light = instance<Light>("environment", {{"picture", picture}, {"samples", std::int64_t{256}}});
    CHECK(worst_error(samples_of(*light), [](Double3 n) { return 0.5 + n.y / 3; }) < 0.02);
}

TEST_CASE("light/environment agrees with the integral of a picture with a sun, in each channel") {
    const auto light = instance<Light>(
        "environment", {{"picture", picture_of(outdoors, 720, 360)}, {"samples", std::int64_t{1024}}});
    const std::vector<PunctualLight> samples = samples_of(*light);
    Random random(3);
    double mean = 0;
    constexpr int k_normals = 40;
    for (int i = 0; i < k_normals; ++i) {
        const Double3 normal = exact(random.direction());
        const Double3 expected = integral(outdoors, normal), actual = reflected(samples, normal);
        INFO("normal " << normal.x << ' ' << normal.y << ' ' << normal.z);
        for (const auto& [a, b] :
             {std::pair{actual.x, expected.x}, {actual.y, expected.y}, {actual.z, expected.z}}) {
            CHECK(std::abs(a / b - 1) < 0.05);
            mean += std::abs(a / b - 1) / (3 * k_normals);
        }
    }
    CHECK(mean < 0.015);
}

TEST_CASE("light/environment turns its picture counter-clockwise, seen from above") {
    // All light from -z, the middle of the picture.
    const std::string picture =
        picture_of([](Double3 d) { return d.z < -0.9999 ? Double3{5, 5, 5} : Double3{}; }, 720, 360);
    for (const auto& [angle, expected] :
         {std::pair{0.0, Vec3{0, 0, -1}}, {90.0, Vec3{-1, 0, 0}}, {-90.0, Vec3{1, 0, 0}}}) {
        const auto light = instance<Light>(
            "environment", {{"picture", picture}, {"rotation", angle}, {"samples", std::int64_t{1}}});
        CHECK(length(samples_of(*light)[0].position - expected) < 1e-3f);
        const candela::EnvironmentMap seen =
            candela::environment_of(*candela::extension_of<candela::SkySource>(*light));
        CHECK(seen.seen(expected).r > 4.9f);
        CHECK(seen.seen(-expected).r == 0);
    }
}

TEST_CASE("light/environment is seen as its picture, multiplied by its intensity") {
    const auto light =
        instance<Light>("environment", {{"picture", picture_of(outdoors, 64, 32)}, {"intensity", 2.0}});
    const candela::EnvironmentMap seen =
        candela::environment_of(*candela::extension_of<candela::SkySource>(*light));
    for (int row = 0; row < 32; ++row) {
        const Double3 d = towards(20.5, row + 0.5, 64, 32);
        const candela::Rgb at =
            seen.seen({static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)});
        REQUIRE(length(exact({at.r, at.g, at.b}) - 2 * outdoors(d)) < 2e-3);
    }
}

TEST_CASE("light/environment repeats a pixel that several samples share, and a black picture is dark") {
    const auto black =
        instance<Light>("environment", {{"picture", picture_of([](Double3) { return Double3{}; }, 4, 2)}});
    for (const PunctualLight& s : samples_of(*black)) {
        CHECK(s.diffuse.r == 0);
        CHECK(std::abs(length(exact(s.position)) - 1) < 1e-6);
    }
    const auto spot =
        instance<Light>("environment", {{"picture", picture_of(
                                                        [](Double3 d) {
                                                            return d.y > 0.5 && d.y < 0.51 && d.x > 0.86
                                                                       ? Double3{1e6, 1e6, 1e6}
                                                                       : Double3{1, 1, 1};
                                                        },
                                                        720, 360)},
                                        {"samples", std::int64_t{1024}}});
    double total = 0;
    for (const PunctualLight& s : samples_of(*spot)) total += static_cast<double>(s.diffuse.r);
    CHECK(std::isfinite(total));
    CHECK(total > 4);
}

TEST_CASE("light/environment shows pictures of any shape with a bounded number of pixels") {
    const auto columns = [](int width, int height) {
        const auto light = instance<Light>(
            "environment",
            {{"picture", picture_of([](Double3) { return Double3{1, 1, 1}; }, width, height)}});
        return candela::extension_of<candela::SkySource>(*light)->sky_columns();
    };
    CHECK(columns(1, 1) == 2);
    CHECK(columns(600, 300) == 600);
    CHECK(columns(3, 200) == 400);
    CHECK(columns(20000, 1) == 8192);
    CHECK(columns(1, 20000) == 8192);
}

TEST_CASE("light/environment says why a picture cannot be read") {
    const std::filesystem::path path = scratch_directory() / "none.pfm";
    std::ofstream(path) << "PF\n2 1\n-1.0\n";
    std::string message;
    try {
        instance<Light>("environment", {{"picture", path.string()}});
    } catch (const candela::Error& problem) {
        message = problem.what();
    }
    CHECK(message.find("none.pfm' cannot be read as a picture") != std::string::npos);
}
