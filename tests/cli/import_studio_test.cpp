// The light of models that have none of their own: the studio, or with --plain a key and a fill light.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

/// A GLB file of a white sphere in the middle, written by the target gltf, without lights.
void write_sphere(const Folder& folder, const std::string& material, const std::string& lights = "") {
    folder.write("sphere.toml",
                 "version = 1\n[observer]\nposition = [0, 0.4, 4]\nlook_at = [0, 0, 0]\nfov = "
                 "40\n[image]\nwidth = 80\nheight "
                 "= 80\n[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"metallic-roughness\"\n" +
                     lights +
                     "[[object]]\ntype = \"sphere\"\nradius = 1\nsegments = 64\ncolor = [255, 255, 255]\n"
                     "[object.material]\n" +
                     material);
    succeeded(folder.run("generate sphere.toml --target gltf --approximate -o glb"));
}

Ppm rendered(const Folder& folder, const std::string& options) {
    succeeded(folder.run("render glb/scene.glb -o a.ppm --quiet --width 80 --height 80 " + options));
    return read_ppm(folder / "a.ppm");
}

/// The share of the sphere that is brighter than a level; and the darkest and brightest level.
struct Levels {
    double bright = 0;
    int least = 255, most = 0;
};

Levels levels_of(const Ppm& picture, int bright) {
    Levels levels;
    int bright_ones = 0, all = 0;
    for (int y = 0; y < picture.height; ++y) {
        for (int x = 0; x < picture.width; ++x) {
            // Well within the rim, which is 27 pixels from the middle.
            if (std::hypot(x - 39.5, y - 39.5) > 22) continue;
            const int level = picture.at(x, y)[1];
            levels.least = std::min(levels.least, level);
            levels.most = std::max(levels.most, level);
            bright_ones += level >= bright ? 1 : 0;
            ++all;
        }
    }
    levels.bright = static_cast<double>(bright_ones) / all;
    return levels;
}

constexpr const char* k_square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n";

}  // namespace

TEST_CASE(
    "a metal sphere mirrors bright boxes and dark walls in the studio, and next to nothing without it") {
    const Folder folder;
    write_sphere(folder, "metallic = 1\nroughness = 0.05\n");
    const Levels studio = levels_of(rendered(folder, ""), 250);
    CHECK(studio.bright > 0.05);
    CHECK(studio.bright < 0.35);
    // Between the boxes: linear 0.25 to 0.4, 137 to 170 in sRGB.
    CHECK(studio.least < 170);
    CHECK(levels_of(rendered(folder, "--plain"), 250).bright < 0.02);
}

TEST_CASE("a matt white sphere is bright in the studio, and nowhere burnt out") {
    const Folder folder;
    write_sphere(folder, "metallic = 0\nroughness = 1\nspecular = 0\n");
    const Levels studio = levels_of(rendered(folder, "--no-shadows"), 230);
    // Linear 0.97 at most, 252 in sRGB; with 64 samples, a little more or less.
    CHECK(studio.most > 240);
    CHECK(studio.most < 255);
    CHECK(studio.bright > 0.4);
    CHECK(studio.least > 100);
}

TEST_CASE("the studio's front faces the observer") {
    const Folder folder;
    for (const auto& [position, rotation] :
         {std::pair{"0, 0.4, 4", "0.0"}, {"4, 0.4, 0", "90.0"}, {"-2.8284271, 1, -2.8284271", "-135.0"}}) {
        write_sphere(folder, "metallic = 1\n");
        std::string scene = folder.read("sphere.toml");
        scene.replace(scene.find("0, 0.4, 4"), 9, position);
        folder.write("sphere.toml", scene);
        succeeded(folder.run("generate sphere.toml --target gltf --approximate -o turned"));
        const std::string imported = succeeded(folder.run("import turned/scene.glb -o -")).out;
        INFO(imported);
        CHECK(holds(imported,
                    fmt::format("type      = \"studio\"\nintensity = 1.0\nrotation  = {}\n", rotation)));
        std::filesystem::remove_all(folder / "turned");
    }
}

TEST_CASE("a file with lights of its own is lit by them alone") {
    const Folder folder;
    write_sphere(folder, "metallic = 1\n",
                 "[[light]]\ntype = \"point\"\nposition = [1, 2, 3]\nintensity = 5\n");
    const std::string scene = succeeded(folder.run("import glb/scene.glb -o -")).out;
    CHECK(holds(scene, "type      = \"point\""));
    CHECK_FALSE(holds(scene, "studio"));
    CHECK(succeeded(folder.run("import glb/scene.glb --plain -o -")).out == scene);
}

TEST_CASE("Phong's materials have a key light for their highlights, besides a dimmer studio") {
    const Folder folder({{"a.obj", k_square}});
    const std::string scene = succeeded(folder.run("import a.obj -o -")).out;
    INFO(scene);
    CHECK(holds(scene, "type      = \"studio\"\nintensity = 0.5\n"));
    CHECK(holds(
        scene,
        "name      = \"key\"\ntype      = \"directional\"\ncolor     = [255, 255, 255]\nintensity = 0.5\n"));
    CHECK_FALSE(holds(scene, "fill"));
    const std::string plain = succeeded(folder.run("import a.obj --plain -o -")).out;
    CHECK_FALSE(holds(plain, "studio"));
    CHECK(holds(plain, "name      = \"fill\""));
}

TEST_CASE("a scene with --plain is refused with the way to do without a studio") {
    const Folder folder({{"a.toml", "version = 1\n[[light]]\ntype = \"studio\"\n"}, {"a.obj", k_square}});
    for (const std::string verb : {"render", "check", "verify"})
        expect(folder.run(verb + " a.toml --plain"), 2,
               {"--plain applies to a model given instead of a scene",
                "remove its [[light]] of type \"studio\""});
    expect(folder.run("check a.obj --plain"), 0);
}
