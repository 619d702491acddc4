#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>
#include <limits>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::EnvironmentMap;
using candela::Rgb;
using candela::Vec3;

namespace {

/// A picture with pixel numbers in red, columns in green, rows in blue.
EnvironmentMap numbered(int width, int height) {
    std::vector<float> intensity;
    for (int row = 0; row < height; ++row) {
        for (int column = 0; column < width; ++column) {
            for (const int number : {row * width + column, column, row})
                intensity.push_back(static_cast<float>(number));
        }
    }
    return {width, height, intensity};
}

bool is_near(Rgb a, float r, float g, float b) {
    return std::abs(a.r - r) < 1e-4f && std::abs(a.g - g) < 1e-4f && std::abs(a.b - b) < 1e-4f;
}

/// The direction of a pixel's middle: longitude from -z towards +x, latitude from +y down.
Vec3 middle(int column, int row, int width, int height) {
    const double longitude = 2 * M_PI * ((column + 0.5) / width - 0.5), polar = M_PI * (row + 0.5) / height;
    return {static_cast<float>(std::sin(polar) * std::sin(longitude)), static_cast<float>(std::cos(polar)),
            static_cast<float>(-std::sin(polar) * std::cos(longitude))};
}

}  // namespace

TEST_CASE("an environment of one intensity has it in every direction") {
    const EnvironmentMap grey({0.25f, 0.5f, 0.75f});
    CHECK(grey.is_uniform());
    CHECK(grey.seen({0, 0, -1}) == Rgb{0.25f, 0.5f, 0.75f});
    CHECK(grey.seen({0.6f, -0.8f, 0}) == Rgb{0.25f, 0.5f, 0.75f});
}

TEST_CASE("an environment's largest intensity is that over all directions and channels") {
    CHECK(EnvironmentMap({0.25f, 0.75f, 0.5f}).max_intensity() == 0.75f);
    CHECK(numbered(8, 4).max_intensity() == 31);
}

TEST_CASE("an environment picture shows a pixel's exact value at the pixel's middle") {
    const EnvironmentMap image = numbered(8, 4);
    CHECK_FALSE(image.is_uniform());
    for (int row = 0; row < 4; ++row) {
        for (int column = 0; column < 8; ++column) {
            INFO("column " << column << ", row " << row);
            CHECK(is_near(image.seen(middle(column, row, 8, 4)), static_cast<float>(row * 8 + column),
                          static_cast<float>(column), static_cast<float>(row)));
        }
    }
}

TEST_CASE(
    "an environment picture has -z in its middle, +x to the right, +y at the top, and its sides meet at +z") {
    const EnvironmentMap image = numbered(8, 4);
    CHECK(is_near(image.seen({0, 0, -1}), (11 + 12 + 19 + 20) / 4.0f, 3.5f, 1.5f));
    CHECK(is_near(image.seen({1, 0, 0}), (13 + 14 + 21 + 22) / 4.0f, 5.5f, 1.5f));
    CHECK(image.seen({0, 1, 0}).b == 0);
    CHECK(image.seen({0, -1, 0}).b == 3);
    // Half of the last column, half of the first.
    CHECK(std::abs(image.seen({0, 0, 1}).g - 3.5f) < 1e-3f);
}

TEST_CASE("an environment of one pixel is that pixel in every direction") {
    const EnvironmentMap image(1, 1, {1, 2, 3});
    Random random(5);
    for (int i = 0; i < 100; ++i) CHECK(is_near(image.seen(random.direction()), 1, 2, 3));
}

TEST_CASE("a NaN direction sees one of the environment's pixels") {
    const EnvironmentMap image(2, 2, {1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1});
    const float none = std::numeric_limits<float>::quiet_NaN();
    CHECK(is_near(image.seen({none, 0, 0}), 1, 1, 1));
    CHECK(is_near(image.seen({0, none, 0}), 1, 1, 1));
}

TEST_CASE("an environment is read decoded from 8-bit files, and unchanged from float files") {
    const auto directory = scratch_directory();
    // Portable pixmap, 2 x 1: white, and middle grey as sRGB encodes 0.2159 (IEC 61966-2-1).
    std::ofstream(directory / "two.ppm", std::ios::binary) << "P6\n2 1\n255\n\xff\xff\xff\x80\x80\x80";
    const EnvironmentMap decoded =
        candela::read_environment(directory / "two.ppm", test_registry(), candela::ColorEncoding::srgb);
    CHECK(is_near(decoded.seen({-1, 0, 0}), 1, 1, 1));
    CHECK(std::abs(decoded.seen({1, 0, 0}).r - 0.2159f) < 1e-4f);
    const EnvironmentMap plain =
        candela::read_environment(directory / "two.ppm", test_registry(), candela::ColorEncoding::none);
    CHECK(std::abs(plain.seen({1, 0, 0}).r - 128 / 255.0f) < 1e-4f);
    // Portable float map, 1 x 1, little-endian.
    std::ofstream map(directory / "one.pfm", std::ios::binary);
    const float pixel[] = {7.5f, 0.25f, 0};
    map << "PF\n1 1\n-1.0\n";
    map.write(reinterpret_cast<const char*>(pixel), sizeof pixel);
    map.close();
    const EnvironmentMap bright =
        candela::read_environment(directory / "one.pfm", test_registry(), candela::ColorEncoding::srgb);
    CHECK(is_near(bright.seen({0, 0, 1}), 7.5f, 0.25f, 0));
}
