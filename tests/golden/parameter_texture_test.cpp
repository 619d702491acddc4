// Parameters of reflection models that have textures, against pictures computed by hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <string>
#include <vector>

#include "golden/image.h"
#include "golden/textured_square.h"
#include "support/command.h"
#include "support/expect.h"

namespace {

/// The square, white, fills the picture, and light comes from the observer: N = L = V. A texel is a pixel.
std::string scene(const std::string& reflection, const std::string& material, const char* encoding,
                  const char* light = "type = \"directional\"\ndirection = [0, 0, -1]") {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 2\n"
        "[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"{3}\"\n[shading]\nmodel = \"phong\"\n"
        "[reflection]\nmodel = \"{1}\"\n[[light]]\n{4}\n"
        "[[object]]\nname = \"square\"\ntype = \"mesh\"\nfile = \"square.obj\"\ncolor = [255, 255, "
        "255]\n[object.material]\n{2}\n",
        k_size, reflection, material, encoding, light);
}

Image rendered(const std::string& reflection, const std::string& material, const char* encoding = "none",
               const char* light = "type = \"directional\"\ndirection = [0, 0, -1]") {
    const auto folder = scratch_directory();
    write_file(folder / "square.obj", k_square);
    write_file(folder / "p.ppm", picture());
    return render_floats(folder, scene(reflection, material, encoding, light));
}

std::array<double, 3> grey(double value) { return {value, value, value}; }

}  // namespace

TEST_CASE("golden: a coefficient takes three channels of its texture, or one") {
    // Lambert's model where N = L: the intensity is kd.
    require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\" }"),
                   [](int x, int y) { return std::array{red(x), green(y), k_blue}; });
    require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", channel = \"g\" }"),
                   [](int, int y) { return grey(green(y)); });
    require_texels(
        rendered("lambert",
                 "ka = 0\nkd = { texture = \"p.ppm\", scale = [0.5, 1, -1], offset = [0.25, 0, 1] }"),
        [](int x, int y) { return std::array{0.25 + 0.5 * red(x), green(y), 1 - k_blue}; });
    SECTION("and stays within its range") {
        require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", scale = 6, offset = -0.2 }"),
                       [](int x, int y) {
                           const auto clamped = [](double v) { return std::clamp(6 * v - 0.2, 0.0, 1.0); };
                           return std::array{clamped(red(x)), clamped(green(y)), 1.0};
                       });
    }
    SECTION("for ambient light, too") {
        require_texels(rendered("lambert", "ka = { texture = \"p.ppm\" }\nkd = 0", "none",
                                "type = \"ambient\"\nintensity = 0.5"),
                       [](int x, int y) { return std::array{0.5 * red(x), 0.5 * green(y), 0.5 * k_blue}; });
    }
}

TEST_CASE("golden: three channels are decoded like colours, and one is linear, unless told otherwise") {
    require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\" }", "srgb"), [](int x, int y) {
        return std::array{decoded(red(x)), decoded(green(y)), decoded(k_blue)};
    });
    require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", channel = \"b\" }", "srgb"),
                   [](int, int) { return grey(k_blue); });
    require_texels(rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", encoding = \"linear\" }", "srgb"),
                   [](int x, int y) { return std::array{red(x), green(y), k_blue}; });
    require_texels(
        rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", channel = \"b\", encoding = \"srgb\" }",
                 "none"),
        [](int, int) { return grey(decoded(k_blue)); });
}

TEST_CASE("golden: a number takes its value from a texture, also where the model prepares constants of it") {
    // Where N = L = V, and F(0) = 0.04: Walter et al. (2007), D = 1 / (pi alpha^2), G = 1; times pi / 4.
    require_texels(rendered("ggx",
                            "ka = 0\nkd = 0\nks = 1\nior = 1.5\nroughness = { texture = \"p.ppm\", channel = "
                            "\"g\", scale = 0.5, offset = 0.5 }"),
                   [](int, int y) { return grey(0.04 / (4 * std::pow(0.5 + 0.5 * green(y), 2))); });
    // Burley (2012): a white metal reflects D G / 4 with D = 1 / roughness^4, and G = 1; what is not metal is
    // diffuse, and white.
    require_texels(
        rendered("disney",
                 "ka = 0\nspecular = 0\nmetallic = { texture = \"p.ppm\", channel = \"r\" }\nroughness "
                 "= { texture = \"p.ppm\", channel = \"g\", scale = 0.5, offset = 0.5 }"),
        [](int x, int y) {
            const double roughness = 0.5 + 0.5 * green(y);
            return grey(1 - red(x) + red(x) / (4 * std::pow(roughness, 4)));
        });
}

TEST_CASE("golden: a transform scales, rotates and moves texture coordinates") {
    const auto texel = [](const std::string& transform) {
        return rendered("lambert", "ka = 0\nkd = { texture = \"p.ppm\", transform = { " + transform + " } }");
    };
    // v grows upwards, rows downwards.
    require_texels(texel("offset = [0.25, 0.125]"), [](int x, int y) {
        return std::array{red((x + 2) % k_size), green((y + k_size - 1) % k_size), k_blue};
    });
    // A quarter turn: (u, v) becomes (-v, u).
    require_texels(texel("rotation = 90"),
                   [](int x, int y) { return std::array{red(y), green(k_size - 1 - x), k_blue}; });
    require_texels(texel("scale = [-1, 1]"),
                   [](int x, int y) { return std::array{red(k_size - 1 - x), green(y), k_blue}; });
    SECTION("and a clamped picture continues with its edge") {
        require_texels(
            rendered(
                "lambert",
                "ka = 0\nkd = { texture = \"p.ppm\", wrap = \"clamp\", transform = { offset = [0.5, 0] } }"),
            [](int x, int y) { return std::array{red(std::min(x + 4, k_size - 1)), green(y), k_blue}; });
    }
}

TEST_CASE("golden: textures of several parameters, and many lights, add up as they do without textures") {
    // Phong where N = L = V: kd + ks for each light, in the order of CA DD6; three lights in one go.
    const char* const light =
        "type = \"directional\"\ndirection = [0, 0, -1]\nintensity = 0.25\n[[light]]\ntype = "
        "\"directional\"\n"
        "direction = [0, 0, -1]\nintensity = 0.5\n[[light]]\ntype = \"ambient\"\nintensity = 0.5";
    require_texels(
        rendered("phong",
                 "ka = { texture = \"p.ppm\", channel = \"r\" }\nkd = { texture = \"p.ppm\", channel = \"g\" "
                 "}\nks = { texture = \"p.ppm\", channel = \"b\", scale = 0.5 }\n",
                 "none", light),
        [](int x, int y) { return grey(0.5 * red(x) + 0.75 * (green(y) + 0.5 * k_blue)); });
}
