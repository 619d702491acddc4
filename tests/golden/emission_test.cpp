// Emission and the occlusion of ambient light, against pictures computed by hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <string>

#include "golden/image.h"
#include "golden/textured_square.h"
#include "support/command.h"
#include "support/expect.h"

namespace {

constexpr const char* k_sun = "[[light]]\nname = \"sun\"\ntype = \"directional\"\ndirection = [0, 0, -1]\n";
constexpr const char* k_ambient = "[[light]]\nname = \"sky\"\ntype = \"ambient\"\nintensity = 0.5\n";

struct Setup {
    std::string material;
    std::string lights = k_sun;
    std::string encoding = "none";
    std::string reflection = "lambert";
    std::string shading = "phong";
    std::string more{};
};

/// The square, white, fills the picture, and light comes from the observer: N = L = V. A texel is a pixel.
std::string scene(const Setup& setup) {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 2\n"
        "[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"{1}\"\n[shading]\nmodel = \"{2}\"\n"
        "[reflection]\nmodel = \"{3}\"\n{4}[[object]]\nname = \"square\"\ntype = \"mesh\"\nfile = "
        "\"square.obj\"\ncolor = [255, 255, 255]\n[object.material]\n{5}\n{6}",
        k_size, setup.encoding, setup.shading, setup.reflection, setup.lights, setup.material, setup.more);
}

std::filesystem::path folder_with_files() {
    const auto folder = scratch_directory();
    write_file(folder / "square.obj", k_square);
    write_file(folder / "p.ppm", picture());
    return folder;
}

Image rendered(const Setup& setup) { return render_floats(folder_with_files(), scene(setup)); }

std::array<double, 3> grey(double value) { return {value, value, value}; }

}  // namespace

TEST_CASE("golden: emission is added once to what a surface reflects, whatever the number of lights") {
    // Lambert's model where N = L: the intensity is kd.
    const std::string material = "ka = 0\nkd = 0.25\nemission = [51, 102, 255]\nemission_strength = 0.5";
    const auto expected = [](double reflected) {
        return [=](int, int) { return std::array{reflected + 0.1, reflected + 0.2, reflected + 0.5}; };
    };
    require_texels(rendered({.material = material, .lights = ""}), expected(0));
    require_texels(rendered({.material = material}), expected(0.25));
    require_texels(rendered({.material = material, .lights = std::string(k_sun) + k_ambient}),
                   expected(0.25));
    require_texels(
        rendered({.material = material + "\n",
                  .lights = std::string(k_sun) + "[[light]]\ntype = \"directional\"\ndirection = "
                                                 "[0, 0, -1]\n[[light]]\ntype = \"point\"\nposition "
                                                 "= [0, 0, -3]\n"}),
        expected(0.5));
    SECTION("with every shading model and any reflection model") {
        for (const char* const shading : {"flat", "gouraud", "phong"})
            require_texels(rendered({.material = material, .shading = shading}), expected(0.25));
        // Phong's specular coefficient, where R = V.
        require_texels(rendered({.material = "kd = 0.2\nks = 0.3\nemission = [51, 102, 255]\n"
                                             "emission_strength = 0.5",
                                 .reflection = "phong"}),
                       expected(0.5));
        require_texels(rendered({.material = "emission = [51, 102, 255]\nemission_strength = 0.5",
                                 .lights = k_ambient,
                                 .reflection = "unlit"}),
                       expected(0.5));
    }
}

TEST_CASE("golden: an emission is a colour, and its strength may exceed 1") {
    require_texels(rendered({.material = "ka = 0\nkd = 0\nemission = [128, 0, 255]\nemission_strength = 40",
                             .encoding = "srgb"}),
                   [](int, int) { return std::array{40 * decoded(128.0 / 255), 0.0, 40.0}; });
    require_texels(
        rendered({.material = "ka = 0\nkd = 0.5\nemission = [128, 0, 255]\nemission_strength = 0"}),
        [](int, int) { return grey(0.5); });
}

TEST_CASE("golden: an emission may be a texture, decoded like a colour unless told otherwise") {
    const auto with = [](const std::string& texture, const char* encoding) {
        return rendered({.material = "ka = 0\nkd = 0.25\nemission_strength = 2\nemission = { texture = "
                                     "\"p.ppm\"" +
                                     texture + " }",
                         .encoding = encoding});
    };
    require_texels(with("", "srgb"), [](int x, int y) {
        return std::array{0.25 + 2 * decoded(red(x)), 0.25 + 2 * decoded(green(y)),
                          0.25 + 2 * decoded(k_blue)};
    });
    require_texels(with("", "none"), [](int x, int y) {
        return std::array{0.25 + 2 * red(x), 0.25 + 2 * green(y), 0.25 + 2 * k_blue};
    });
    require_texels(with(", encoding = \"linear\", scale = [1, 0.5, 4], offset = [0, 0.25, 0]", "srgb"),
                   [](int x, int y) {
                       return std::array{0.25 + 2 * red(x), 0.25 + 2 * (0.25 + 0.5 * green(y)),
                                         0.25 + 2 * 1.0};
                   });
    require_texels(with(", channel = \"g\", transform = { offset = [0.25, 0.125] }", "srgb"),
                   [](int, int y) { return grey(0.25 + 2 * green((y + k_size - 1) % k_size)); });
}

TEST_CASE("golden: what a surface emits lights nothing else, and no shadow falls on it") {
    const std::string wall =
        "[[object]]\nname = \"lamp\"\ntype = \"sphere\"\nradius = 0.3\nposition = [0, 0, 4.6]\n"
        "[object.material]\nemission = [255, 255, 255]\nemission_strength = 1000\n[shadows]\nenabled = "
        "true\n";
    require_texels(rendered({.material = "ka = 0\nkd = 0.5", .lights = "", .more = wall}),
                   [](int, int) { return grey(0); });
    // The sphere, out of sight behind the observer, blocks the sun in the middle of the square.
    const Image image = rendered({.material = "ka = 0\nkd = 0.5\nemission = [51, 51, 51]", .more = wall});
    CHECK(std::abs(image.at(3, 3).x - 0.2f) < 1e-6f);
    CHECK(std::abs(image.at(0, 0).x - 0.7f) < 1e-6f);
}

TEST_CASE("golden: occlusion multiplies only what is reflected of ambient light") {
    const std::string both = std::string(k_sun) + k_ambient;
    require_texels(rendered({.material = "ka = 0.8\nkd = 0.25\nocclusion = 0.5", .lights = both}),
                   [](int, int) { return grey(0.25 + 0.5 * 0.5 * 0.8); });
    require_texels(rendered({.material = "ka = 0.8\nkd = 0.25\nocclusion = 0.5\nemission = [51, 51, 51]",
                             .lights = both}),
                   [](int, int) { return grey(0.2 + 0.25 + 0.5 * 0.5 * 0.8); });
    SECTION("by a picture, whose strength is a scale and an offset") {
        const std::string material =
            "ka = 0.8\nkd = 0.25\nocclusion = { texture = \"p.ppm\", scale = 0.7, offset = 0.3 }";
        for (const char* const encoding : {"none", "srgb"})
            require_texels(rendered({.material = material, .lights = both, .encoding = encoding}),
                           [](int x, int) { return grey(0.25 + (0.3 + 0.7 * red(x)) * 0.5 * 0.8); });
        require_texels(
            rendered({.material = "ka = 0.8\nkd = 0.25\nocclusion = { texture = \"p.ppm\", channel "
                                  "= \"g\", scale = 4 }",
                      .lights = both}),
            [](int, int y) { return grey(0.25 + std::min(1.0, 4 * green(y)) * 0.5 * 0.8); });
    }
    SECTION("with every light of a scene that has several, each counted once") {
        const std::string more =
            "[[light]]\ntype = \"hemisphere\"\nsky_color = [255, 255, 255]\nground_color = [255, 255, 255]\n"
            "intensity = 0.25\n[[light]]\ntype = \"ambient\"\nintensity = 0.5\n";
        require_texels(rendered({.material = "ka = 0.8\nkd = 0.25\nocclusion = 0.5", .lights = both + more}),
                       [](int, int) { return grey(0.25 + 0.5 * (0.5 + 0.25 + 0.5) * 0.8); });
    }
}

TEST_CASE("golden: a material's own textures, its emission and its occlusion may share a picture") {
    require_texels(
        rendered({.material =
                      "ka = 1\nkd = { texture = \"p.ppm\", channel = \"b\" }\nocclusion = { texture = "
                      "\"p.ppm\", channel = \"r\" }\nemission = { texture = \"p.ppm\", channel = \"g\" }",
                  .lights = std::string(k_sun) + k_ambient}),
        [](int x, int y) { return grey(k_blue + 0.5 * red(x) + green(y)); });
}
