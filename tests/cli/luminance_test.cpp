// Luminances in false colours, with their legend.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

constexpr int k_width = 40, k_height = 120;

/// A sphere that sends `luminance` cd/m² in all directions, in the middle of a picture with a grey
/// background.
std::string glowing(double luminance, const std::string& of_observer = "") {
    return fmt::format(
        "version = 1\nimage = {{ width = {}, height = {}, background = [90, 90, 90] }}\n"
        "observer = {{ position = [0, 0, 4], look_at = [0, 0, 0]{} }}\n"
        "shading = {{ model = \"phong\" }}\nreflection = {{ model = \"lambert\" }}\n[[light]]\ntype = "
        "\"ambient\"\nintensity = 0\n"
        "[[object]]\nname = \"lamp\"\ntype = \"sphere\"\n[object.material]\n"
        "emission = [255, 255, 255]\nemission_strength = {}\n",
        k_width, k_height, of_observer, luminance);
}

bool is_near(const std::array<int, 3>& a, const std::array<int, 3>& b, int levels) {
    for (std::size_t c = 0; c < 3; ++c)
        if (std::abs(a[c] - b[c]) > levels) return false;
    return true;
}

}  // namespace

TEST_CASE("luminances have viridis' colours on a logarithmic scale, whatever the exposure") {
    // From matplotlib's table of 256 colours, in levels: those at 64, 128 and 192, and the ends.
    struct Known {
        double position;
        std::array<int, 3> color;
    };
    const Known known[] = {{-40, {68, 1, 84}},    {0, {68, 1, 84}},     {64, {59, 82, 139}},
                           {128, {33, 145, 140}}, {192, {94, 201, 98}}, {255, {253, 231, 37}},
                           {300, {253, 231, 37}}};
    const Folder d;
    for (const char* const observer : {"", ", exposure = 3"}) {
        for (const Known& one : known) {
            // The scale below has three decades from 0.5.
            d.write("scene.toml", glowing(0.5 * std::pow(1000, one.position / 255), observer));
            succeeded(
                d.run("render scene.toml -o a.ppm --terms luminance --luminance-scale 0.5,500 --quiet"));
            const Ppm picture = read_ppm(d / "a.luminance.ppm");
            CHECK(picture.height == k_height);
            const auto color = picture.at(k_width / 2, k_height / 2);
            INFO(one.position << ": " << color[0] << ' ' << color[1] << ' ' << color[2]);
            CHECK(is_near(color, one.color, 3));
            // The background is a colour of the picture, not light.
            CHECK(picture.at(2, 2) == std::array{0, 0, 0});
        }
    }
}

TEST_CASE("explain gives the luminance of a pixel") {
    const Folder d({{"scene.toml", glowing(30, ", exposure = 3")}});
    const auto at = [&](const char* pixel) {
        return succeeded(d.run("explain scene.toml --pixel", {pixel})).out;
    };
    CHECK(holds(at("20,60"), "\nluminance = 30 cd/m²\nred: I = 30, exposed"));
    CHECK(holds(at("2,2"), "\nluminance = 0 cd/m²\n"));
    CHECK(holds(succeeded(d.run("explain scene.toml --pixel 20,60 --json")).out, "\"luminance\": 30.0"));
}

TEST_CASE("the legend's bar is next to the picture, brightest at the top, with black marks") {
    const Folder d({{"scene.toml", glowing(30)}});
    succeeded(d.run("render scene.toml -o a.ppm --terms luminance --quiet"));
    const Ppm picture = read_ppm(d / "a.luminance.ppm");
    REQUIRE(picture.width > k_width + 20);
    const int bar = k_width + 8;
    int first = -1, last = -1;
    for (int y = 0; y < k_height; ++y) {
        if (is_near(picture.at(bar, y), {253, 231, 37}, 2) && first < 0) first = y;
        if (is_near(picture.at(bar, y), {68, 1, 84}, 2)) last = y;
    }
    REQUIRE(first >= 0);
    REQUIRE(last > first + k_height / 2);
    // The powers of ten around 30 are 10 and 100. A mark's tick is right of the bar, at its height.
    const auto has_tick = [&](int y) { return picture.at(k_width + 4 + 12 + 1, y) == std::array{0, 0, 0}; };
    const auto height_of = [&](double luminance) {
        return last - static_cast<int>(std::lround(std::log10(luminance / 10) * (last - first)));
    };
    for (const double luminance : {10.0, 20.0, 50.0, 100.0}) {
        INFO(luminance);
        CHECK(has_tick(height_of(luminance)));
        CHECK_FALSE(has_tick(height_of(luminance) + 3));
    }
    // The picture's own colour is the bar's at 30 cd/m².
    CHECK(is_near(picture.at(k_width / 2, k_height / 2), picture.at(bar, height_of(30)), 3));
}

TEST_CASE("a sheet of luminances has one scale and one legend") {
    const Folder d({{"scene.toml", glowing(3)}});
    const std::string vary =
        "compare scene.toml --vary object.lamp.material.emission_strength=5.662,181.6 -o a.ppm ";
    succeeded(d.run(vary + "--terms luminance --luminance-scale 1,1000 --quiet"));
    const Ppm sheet = read_ppm(d / "a.ppm");
    succeeded(d.run(vary + "--terms diffuse --quiet"));
    const Ppm plain = read_ppm(d / "a.ppm");
    CHECK(sheet.height == plain.height);
    CHECK(sheet.width > plain.width + 20);
    CHECK(sheet.width < plain.width + k_width + 40);
    const auto left = sheet.at(4 + k_width / 2, 4 + k_height / 2);
    const auto right = sheet.at(8 + k_width + k_width / 2, 4 + k_height / 2);
    // These luminances are 64 and 192 of 255 along the scale.
    CHECK(is_near(left, {59, 82, 139}, 3));
    CHECK(is_near(right, {94, 201, 98}, 3));
}

TEST_CASE("a scale of luminances is two increasing numbers") {
    const Folder d({{"scene.toml", glowing(3)}});
    for (const char* const scale :
         {"5", "5,", ",5", "5,1", "1,1", "0,1", "-1,1", "nan,1", "1,inf", "1,2,3", "1 2", "1e-50,1", "a,b"}) {
        expect(d.run_words({"render", "scene.toml", "-o", "a.ppm", "--terms", "luminance",
                            "--luminance-scale", scale}),
               2,
               {fmt::format("--luminance-scale is '{}'; expected two luminances above 0 in cd/m²", scale)});
    }
}
