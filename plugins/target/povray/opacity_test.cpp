// Opacity in POV-Ray scenes, drawn by POV-Ray.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"

namespace {

/// One texel, of 51, 102 and 255.
const std::string k_dot = std::string("P6\n1 1\n255\n\x33\x66\xff", 14);

/// A square that covers the middle of a picture twice as wide as high.
constexpr const char* k_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float wear\nproperty float s\nproperty float t\nelement face 2\nproperty list uchar int "
    "vertex_indices\nend_header\n"
    "-1 -1 0 0 0 0\n1 -1 0 1 1 0\n1 1 0 1 1 1\n-1 1 0 0 0 1\n3 0 1 2\n3 0 2 3\n";

/// The middle pixel of a red ball before a blue wall, in levels of red and of blue.
std::array<int, 2> through_a_ball(const Folder& folder, const std::string& material) {
    folder.write("scene.toml",
                 "version = 1\nimage = { width = 16, height = 8, color_management = \"none\" }\n"
                 "observer = { position = [0, 0, 4], look_at = [0, 0, 0] }\n"
                 "shading = { model = \"phong\" }\nreflection = { model = \"unlit\" }\n"
                 "[[light]]\ntype = \"ambient\"\nintensity = 1\n[[object]]\ntype = \"sphere\"\n"
                 "color = [255, 0, 0]\n[object.material]\n" +
                     material +
                     "\n[[object]]\ntype = \"cube\"\nposition = [0, 0, -3]\nsize = 3\ncolor = [0, 0, 255]\n");
    succeeded(folder.run("generate scene.toml --target povray --approximate -o made"));
    CommandSetup setup{.directory = folder / "made"};
    succeeded(run_program({"povray", "scene.ini", "+FP", "+Opicture.ppm"}, setup));
    const auto [red, green, blue] = read_ppm(folder / "made/picture.ppm").middle();
    CHECK(green == 0);
    return {red, blue};
}

}  // namespace

TEST_CASE("target/povray: both sides of a see-through ball cover their part of what is behind them") {
    const Folder folder({{"dot.ppm", k_dot}});
    // 1 - 0.75^2 = 0.4375, and 0.5625 is left.
    CHECK(through_a_ball(folder, "opacity = 0.25") == std::array{112, 143});
    // 51 / 255 = 0.2; 1 - 0.8^2 = 0.36, and 0.64 is left.
    CHECK(through_a_ball(folder, "opacity = { texture = \"dot.ppm\" }") == std::array{92, 163});
    // 0.2 * 0.4 = 0.08, both by pictures; 1 - 0.92^2 = 0.1536.
    CHECK(through_a_ball(
              folder, "opacity = [{ texture = \"dot.ppm\" }, { texture = \"dot.ppm\", channel = \"g\" }]") ==
          std::array{39, 216});
    SECTION("and a cut-out is opaque or absent") {
        CHECK(through_a_ball(folder, "opacity = 0.25\nopacity_cutoff = 0.3") == std::array{0, 255});
        const std::string texture = "opacity = { texture = \"dot.ppm\" }\nopacity_cutoff = ";
        CHECK(through_a_ball(folder, texture + "0.15") == std::array{255, 0});
        CHECK(through_a_ball(folder, texture + "0.25") == std::array{0, 255});
    }
}

TEST_CASE("target/povray: vertices' opacities and colours are interpolated exactly") {
    const Folder folder({{"square.ply", k_ply}, {"dot.ppm", k_dot}});
    const auto levels = [&](const std::string& material, const std::string& object = {}) {
        folder.write(
            "scene.toml",
            "version = 1\nimage = { width = 16, height = 8, color_management = \"none\", background = [0, "
            "0, 255] }\nobserver = { position = [0, 0, 4], look_at = [0, 0, 0], projection = "
            "\"orthographic\", height = 2 }\nshading = { model = \"phong\" }\nreflection = { model = "
            "\"unlit\" }\n[[light]]\ntype = \"ambient\"\n[[object]]\ntype = \"mesh\"\nfile = "
            "\"square.ply\"\n" +
                (object.empty() ? "color = [255, 0, 0]\n" : object) + "[object.material]\n" + material +
                "\n");
        succeeded(folder.run("generate scene.toml --target povray --approximate -o made"));
        CommandSetup setup{.directory = folder / "made"};
        succeeded(run_program({"povray", "scene.ini", "+FP", "+Opicture.ppm"}, setup));
        std::vector<std::array<int, 3>> row;
        const Ppm picture = read_ppm(folder / "made/picture.ppm");
        for (int x = 0; x < picture.width; ++x) row.push_back(picture.at(x, 2));
        return row;
    };
    const auto level = [](double intensity) { return static_cast<int>(std::lround(255 * intensity)); };
    const auto matches = [&](const std::vector<std::array<int, 3>>& row, const auto& expected) {
        for (std::size_t x = 4; x < 12; ++x) {
            const std::array<double, 3> wanted = expected((static_cast<double>(x) - 3.5) / 8);
            for (std::size_t c = 0; c < 3; ++c) {
                INFO("column " << x << ", channel " << c);
                CHECK(std::abs(row[x][c] - level(wanted[c])) <= 1);
            }
        }
    };
    // The square covers the middle eight columns; its wear grows from left to right.
    matches(levels("opacity = { attribute = \"wear\" }"), [](double s) { return std::array{s, 0.0, 1 - s}; });
    matches(
        levels("opacity = [{ attribute = \"wear\", scale = 0.5 }, { texture = \"dot.ppm\", channel = \"g\" "
               "}]"),
        [](double s) { return std::array{0.2 * s, 0.0, 1 - 0.2 * s}; });
    matches(levels("",
                   "color = { attribute = \"wear\", channel = \"r\", scale = [1, 0.5, 0], offset = [0, 0.5, "
                   "0.25] }\n"),
            [](double s) { return std::array{s, 0.5 + 0.5 * s, 0.25}; });
}

TEST_CASE(
    "target/povray: light through vertices' opacities, and the colours of a lit mesh, match Candela's") {
    const Folder folder({{"square.ply", k_ply}});
    folder.write(
        "scene.toml",
        "version = 1\nobserver = { position = [0, 1.5, 5], look_at = [0, 0, 0] }\nimage = { width = 96, "
        "height = 64 "
        "}\nshading = { model = \"phong\" }\nreflection = { model = \"phong\" }\nconstraints = { overlap = "
        "\"allow\" }\nshadows = { enabled = true }\n[[light]]\ntype = \"point\"\nposition = [-2, 4, 3]\n"
        "intensity = 20\n[[light]]\ntype = \"ambient\"\nintensity = 0.5\n"
        "[[object]]\ntype = \"mesh\"\nfile = \"square.ply\"\nscale = 0.8\nposition = [-1, 0, 0]\nmaterial = "
        "{ "
        "opacity = { attribute = \"wear\" } }\n"
        "[[object]]\ntype = \"mesh\"\nfile = \"square.ply\"\nscale = 0.8\nposition = [1, 0, 0]\nrotation = "
        "[0, 20, "
        "0]\ncolor = { attribute = \"wear\", channel = \"r\", scale = [0.8, -0.5, 0], offset = [0, 0.6, 0.3] "
        "}\n"
        "[[object]]\ntype = \"cube\"\nsize = 4\nposition = [0, -3, -1]\nreflection = \"lambert\"\n");
    const CommandResult result = folder.run("verify scene.toml --target povray --approximate --tolerance 3");
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
}

TEST_CASE("target/povray: highlights and shadows of see-through surfaces match Candela's") {
    const Folder folder;
    folder.write(
        "scene.toml",
        "version = 1\nobserver = { position = [0, 1.5, 5], look_at = [0, 0, 0] }\nimage = { width = 96, "
        "height = "
        "64 }\nshading = { model = \"phong\" }\nreflection = { model = \"phong\" }\nconstraints = { overlap "
        "= "
        "\"allow\" }\nshadows = { enabled = true }\n[[light]]\ntype = \"point\"\nposition = [-2, 4, "
        "3]\nintensity = 15\n[[light]]\ntype = \"ambient\"\nintensity = 0.5\n"
        "[[object]]\ntype = \"sphere\"\nsegments = 64\nradius = 0.7\nposition = [-0.8, 0, 0]\nmaterial = { "
        "opacity "
        "= 0.4, ks = [0.6, 0.3, 0.1] }\n"
        "[[object]]\ntype = \"cube\"\nsize = 0.8\nposition = [0.7, 0, 0.3]\ncolor = [60, 200, 80]\nmaterial "
        "= { "
        "opacity = 0.7 }\n"
        "[[object]]\ntype = \"cube\"\nsize = 3\nposition = [0, -2.5, 0]\nreflection = \"lambert\"\n");
    const CommandResult result = folder.run("verify scene.toml --target povray --approximate --tolerance 3");
    INFO(result.out << result.err);
    CHECK(result.exit_code == 0);
}
