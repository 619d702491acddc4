// Units and colour temperatures of lights: what the values in a scene mean, by definitions and published
// tables.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <string>
#include <variant>

#include "console/diagnostics_text.h"
#include "support/compiled.h"
#include "support/plugins.h"
#include "support/text.h"

namespace {

std::string scene(const std::string& light) {
    return "version = 1\n[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n[[light]]\nname = "
           "\"lamp\"\n" +
           light;
}

std::optional<candela::Scene> read(const std::string& light, candela::Diagnostics& diagnostics) {
    candela::SceneRequest request;
    request.files = {"scene.toml"};
    request.streams = {{"scene.toml", scene(light)}};
    return candela::read_scene(request, test_registry(), diagnostics);
}

candela::LightSource lamp(const std::string& light) {
    candela::Diagnostics diagnostics;
    const auto read_scene = read(light, diagnostics);
    INFO(diagnostics_text(diagnostics, false, 1000));
    REQUIRE(read_scene);
    return read_scene->lights.at(0);
}

double intensity(const std::string& light) {
    return std::get<double>(lamp(light).model.parameters.get("intensity"));
}

/// The diagnostics of a scene that must be refused.
std::string refusal(const std::string& light) {
    candela::Diagnostics diagnostics;
    CHECK_FALSE(read(light, diagnostics));
    return diagnostics_text(diagnostics, false, 1000);
}

bool is_near(double found, double expected, double tolerance) {
    return std::abs(found - expected) <= tolerance * std::abs(expected);
}

const std::string k_point = "type = \"point\"\nposition = [0, 2, 0]\n";
const std::string k_sun = "type = \"directional\"\ndirection = [0, -1, 0]\n";
constexpr double k_pi = std::numbers::pi;

/// A light's colour times its intensity, in linear sRGB.
struct Emission {
    double r, g, b;
    double luminance() const { return 0.2126 * r + 0.7152 * g + 0.0722 * b; }
};
Emission emission(const candela::LightSource& light) {
    const auto color = std::get<candela::Vec3>(light.model.parameters.get("color"));
    const double strength = std::get<double>(light.model.parameters.get("intensity"));
    const auto linear = [&](float c) {
        const double x = double{c} / 255;
        return strength * (x <= 0.04045 ? x / 12.92 : std::pow((x + 0.055) / 1.055, 2.4));
    };
    return {linear(color.x), linear(color.y), linear(color.z)};
}

}  // namespace

TEST_CASE("a luminous intensity and an illuminance are divided by pi, as models reflect without 1 / pi") {
    CHECK(is_near(intensity(k_point + "intensity = \"1200 cd\""), 1200 / k_pi, 1e-6));
    CHECK(is_near(intensity(k_point + "intensity = \" 1.2kcd \""), 1200 / k_pi, 1e-6));
    CHECK(is_near(intensity(k_point + "intensity = \"500mcd\""), 0.5 / k_pi, 1e-6));
    CHECK(is_near(intensity(k_sun + "intensity = \"5 klx\""), 5000 / k_pi, 1e-6));
    CHECK(is_near(intensity(k_sun + "intensity = \"+1e5 lx\""), 1e5 / k_pi, 1e-6));
    CHECK(intensity(k_point + "intensity = 20") == 20);
}

TEST_CASE("a flux is spread over the sphere, and a watt is 683 lumens") {
    CHECK(is_near(intensity(k_point + "intensity = \"800 lm\""), 800 / (4 * k_pi) / k_pi, 1e-6));
    CHECK(is_near(intensity(k_point + "intensity = \"60 W\""), 60 * 683 / (4 * k_pi) / k_pi, 1e-6));
}

TEST_CASE("the light in a spot's cone adds up to its flux, with either falloff") {
    for (const double outer : {10.0, 30.0, 89.0}) {
        const double inner = 0.6 * outer;
        const double degrees = k_pi / 180, cos_inner = std::cos(inner * degrees),
                     cos_outer = std::cos(outer * degrees);
        for (const bool is_smooth : {true, false}) {
            const double strength = intensity(
                "type = \"spot\"\nposition = [0, 2, 0]\ndirection = [0, -1, 0]\nintensity = \"800 lm\"\n"
                "inner_angle = " +
                std::to_string(inner) + "\nouter_angle = " + std::to_string(outer) +
                (is_smooth ? "" : "\nfalloff = \"linear\""));
            // The integral of the intensity in cd over solid angle.
            double flux = 0;
            constexpr int k_steps = 200000;
            for (int i = 0; i < k_steps; ++i) {
                const double cosine = cos_outer + (1 - cos_outer) * (i + 0.5) / k_steps;
                const double t = std::min(1.0, (cosine - cos_outer) / (cos_inner - cos_outer));
                flux += (is_smooth ? t * t * (3 - 2 * t) : t) * 2 * k_pi * (1 - cos_outer) / k_steps;
            }
            CHECK(is_near(k_pi * strength * flux, 800, 1e-4));
        }
    }
}

TEST_CASE("a unit that does not suit the light, or is unknown, is refused with those that suit it") {
    CHECK(holds(
        refusal(k_point + "intensity = \"800 lx\"\n"),
        "scene.toml:9:13: error: 'intensity' is a string, \"800 lx\"; expected a number, at least 0, or "
        "\"800 lm\", \"1200 cd\" or \"60 W\""));
    CHECK(holds(refusal(k_point + "intensity = \"800 lx\"\n"), "lx is for lights from far away"));
    CHECK(holds(refusal(k_sun + "intensity = \"800 lm\"\n"), "expected a number, at least 0, or \"5 klx\""));
    CHECK(holds(refusal(k_point + "intensity = \"800 lumen\"\n"), "\"800 lumen\"; expected"));
    CHECK(holds(refusal(k_point + "intensity = \"bright\"\n"), "\"bright\"; expected"));
    CHECK(holds(refusal(k_point + "intensity = \"nan lm\"\n"), "expected"));
    CHECK(holds(refusal(k_point + "intensity = \"-3 lm\"\n"), "outside its range: at least 0"));
    // A photometric file has candela already.
    const std::string ies = "type = \"ies\"\nposition = [0, 2, 0]\ndirection = [0, -1, 0]\n";
    CHECK(holds(refusal(ies + "intensity = \"800 lm\"\n"), "is a string, \"800 lm\"; expected a number"));
    CHECK(intensity(ies + "intensity = 2\n") == 2);
    CHECK(holds(refusal("type = \"ambient\"\nintensity = \"3 cd\"\n"), "expected a number, at least 0"));
    CHECK(holds(refusal(k_point + "attenuation_offset = \"3 cd\"\n"), "expected a number, at least 0"));
}

TEST_CASE(
    "a black body's chromaticity is the published one, and its luminance that of the light without it") {
    // CIE 15: illuminant A is 2856 K at the scale of 1968; the others are of Wyszecki, Stiles 1982, table
    // I(6.3.3).
    struct Known {
        int kelvin;
        double x, y;
    };
    for (const Known& known :
         {Known{2856, 0.4476, 0.4074}, Known{4000, 0.3805, 0.3768}, Known{5000, 0.3451, 0.3516},
          Known{6500, 0.3135, 0.3237}, Known{10000, 0.2807, 0.2884}}) {
        const Emission found =
            emission(lamp(k_point + "intensity = 3\ntemperature = " + std::to_string(known.kelvin) + "\n"));
        INFO(known.kelvin);
        CHECK(is_near(found.luminance(), 3, 1e-4));
        const double x = 0.4124 * found.r + 0.3576 * found.g + 0.1805 * found.b;
        const double y = 0.2126 * found.r + 0.7152 * found.g + 0.0722 * found.b;
        const double z = 0.0193 * found.r + 0.1192 * found.g + 0.9505 * found.b;
        CHECK(std::abs(x / (x + y + z) - known.x) < 4e-4);
        CHECK(std::abs(y / (x + y + z) - known.y) < 4e-4);
    }
    const Emission warm = emission(lamp(k_point + "temperature = 1500\n"));
    CHECK(warm.b == 0);
    CHECK(is_near(warm.luminance(), 1, 1e-4));
}

TEST_CASE(
    "a temperature multiplies the light's own colour, and one out of range or without effect is reported") {
    const Emission red = emission(lamp(k_point + "color = [255, 0, 0]\ntemperature = 3200\n"));
    const Emission all = emission(lamp(k_point + "temperature = 3200\n"));
    CHECK(is_near(red.r, all.r, 1e-5));
    CHECK(red.g == 0);
    CHECK(holds(refusal(k_point + "temperature = 500\n"),
                "scene.toml:9:15: error: 'temperature' is 500 K; expected 1000 to 15000 K, or 0 for none"));
    CHECK(holds(refusal(k_point + "temperature = 90000\n"), "outside its range: 0 to 15000"));
    candela::Diagnostics diagnostics;
    CHECK(read("type = \"hemisphere\"\ntemperature = 3000\n", diagnostics));
    CHECK(holds(diagnostics_text(diagnostics, false, 1000), "'temperature' has no effect"));
}

TEST_CASE("a written scene has the units, colours and temperature as their author wrote them") {
    candela::Diagnostics diagnostics;
    const auto original =
        read(k_point + "intensity = \"800 lm\"\ncolor = [255, 250, 240]\ntemperature = 3200\n", diagnostics);
    REQUIRE(original);
    const std::string text = candela::scene_text(*original);
    INFO(text);
    CHECK(holds(text, "= \"800 lm\"\n"));
    CHECK(holds(text, "= [255, 250, 240]\n"));
    CHECK(holds(text, "= 3200.0\n"));
    candela::SceneRequest request;
    request.files = {"again.toml"};
    request.streams = {{"again.toml", text}};
    CHECK(candela::read_scene(request, test_registry(), diagnostics) == original);
}
