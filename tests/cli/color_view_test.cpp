// Views of OpenColorIO configurations.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

/// Two displays; `Swapped` exchanges red and blue, `Plain` of the screen is a power.
constexpr const char* k_config = R"(ocio_profile_version: 2
search_path: .
roles:
  default: lin_rec709
  scene_linear: lin_rec709
displays:
  screen:
    - !<View> {name: Plain, colorspace: power}
    - !<View> {name: Swapped, colorspace: swapped}
  paper:
    - !<View> {name: Matte, colorspace: lin_rec709}
colorspaces:
  - !<ColorSpace>
    name: lin_rec709
  - !<ColorSpace>
    name: power
    from_scene_reference: !<ExponentTransform> {value: [2.2, 2.2, 2.2, 1], direction: inverse}
  - !<ColorSpace>
    name: swapped
    from_scene_reference: !<MatrixTransform> {matrix: [0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1]}
)";

/// A sphere that sends (0.8, 0.8 * 0.2158605, 0), under which there is an exposure of 1/2.
std::string scene() {
    return fmt::format(
        "version = 1\nimage = {{ width = 8, height = 8, tone = \"agx\" }}\n"
        "observer = {{ position = [0, 0, 4], look_at = [0, 0, 0], exposure = {} }}\n"
        "shading = {{ model = \"phong\" }}\nreflection = {{ model = \"lambert\" }}\n"
        "[[light]]\ntype = \"ambient\"\nintensity = 0\n"
        "[[object]]\ntype = \"sphere\"\n[object.material]\n"
        "emission = [255, 128, 0]\nemission_strength = 0.8\n",
        std::log2(1 / (1.2 * 0.5)));
}

int byte(double shown) { return static_cast<int>(std::lround(255 * shown)); }

}  // namespace

TEST_CASE("a view of an OpenColorIO configuration takes the place of the tone curve, after the exposure") {
    const Folder d({{"scene.toml", scene()}, {"c.ocio", k_config}});
    const auto shown = [&](const std::string& options, const Folder::Environment& environment = {}) {
        succeeded(d.run("render scene.toml -o a.ppm --quiet " + options, {}, environment));
        return read_ppm(d / "a.ppm").middle();
    };
    const double r = 0.4, g = 0.4 * 0.2158605;
    const std::array<int, 3> plain{byte(std::pow(r, 1 / 2.2)), byte(std::pow(g, 1 / 2.2)), 0};
    CHECK(shown("--color-config c.ocio --view Plain") == plain);
    CHECK(shown("--color-config c.ocio") == plain);
    CHECK(shown("--view Plain", {{"OCIO", "c.ocio"}}) == plain);
    CHECK(shown("--color-config c.ocio --view Swapped") == std::array<int, 3>{0, byte(g), byte(r)});
    CHECK(shown("--color-config c.ocio --display paper") == std::array<int, 3>{byte(r), byte(g), 0});
}

TEST_CASE("frames of an animation are shown through a view") {
    const Folder d(
        {{"scene.toml", scene() + "[animation]\nframes = 2\nfps = 1\n[[animation.track]]\npath = "
                                  "\"object.0.material.emission_strength\"\nkeys = [[0, 0.8], [1, 0.4]]\n"},
         {"c.ocio", k_config}});
    const std::string animate = "animate scene.toml -o %d.ppm ";
    const auto red_of = [&](const char* frame) { return read_ppm(d / frame).middle()[0]; };
    succeeded(d.run(animate + "--color-config c.ocio"));
    CHECK(red_of("0.ppm") == byte(std::pow(0.4, 1 / 2.2)));
    CHECK(red_of("1.ppm") == byte(std::pow(0.2, 1 / 2.2)));
    SECTION("and rendered again where the view or its configuration is another") {
        const auto kept = [&](const std::string& options) {
            const CommandResult done = succeeded(d.run(animate + options));
            return holds(done.out + done.err, "2 of them already up to date");
        };
        CHECK(kept("--color-config c.ocio"));
        CHECK_FALSE(kept("--color-config c.ocio --view Swapped"));
        CHECK(red_of("0.ppm") == 0);
        CHECK(kept("--color-config c.ocio --view Swapped"));
        d.write("c.ocio", k_config + std::string("\n"));
        CHECK_FALSE(kept("--color-config c.ocio --view Swapped"));
        CHECK_FALSE(kept(""));
    }
    SECTION("also by tasks") {
        succeeded(d.run("submit scene.toml -o s%d.ppm --color-config c.ocio --display paper --jobs 1"));
        CHECK(red_of("s0.ppm") == byte(0.4));
        CHECK(red_of("s1.ppm") == byte(0.2));
        expect(d.run("submit scene.toml -o a.ppm --parts 2 --color-config c.ocio"), 2,
               {"--view and --parts cannot be combined"});
    }
    expect(d.run(animate + "--color-config c.ocio --view Plane"), 2, {"unknown view 'Plane'"});
    expect(d.run("animate scene.toml -o %d.pfm --color-config c.ocio"), 2,
           {"files of type .pfm have the intensities"});
}

TEST_CASE("pictures of a sheet are shown through a view, terms without it") {
    const Folder d({{"scene.toml", scene()}, {"c.ocio", k_config}});
    succeeded(
        d.run("compare scene.toml --vary object.0.material.emission_strength=0.8,0.4 --columns 2 -o a.ppm "
              "--color-config c.ocio --view Swapped"));
    const Ppm sheet = read_ppm(d / "a.ppm");
    // The middles of the two pictures of 8 pixels, next to margins of the sheet.
    const auto has = [&](std::array<int, 3> wanted) {
        for (int y = 0; y < sheet.height; ++y)
            for (int x = 0; x < sheet.width; ++x)
                if (sheet.at(x, y) == wanted) return true;
        return false;
    };
    const double r = 0.4, g = 0.4 * 0.2158605;
    CHECK(has({0, byte(g), byte(r)}));
    CHECK(has({0, byte(g / 2), byte(r / 2)}));
    expect(d.run("compare scene.toml --shading flat,phong --color-config c.ocio --view Plane -o b.ppm"), 2,
           {"unknown view 'Plane'"});
    CHECK_FALSE(d.has("b.ppm"));
}

TEST_CASE("mistakes in views are reported with the known ones, before anything is rendered") {
    const Folder d({{"scene.toml", scene()}, {"c.ocio", k_config}, {"broken.ocio", "roles: ["}});
    const auto fails = [&](const std::string& options, const std::string& message) {
        expect(d.run("render scene.toml -o a.png " + options, {}, {{"OCIO", ""}}), 2, {message});
        CHECK_FALSE(d.has("a.png"));
    };
    fails("--color-config c.ocio --view Plane",
          "--view: unknown view 'Plane'; did you mean 'Plain'?; possible: Plain, Swapped");
    fails("--color-config c.ocio --view Matte", "--view: unknown view 'Matte'; possible: Plain, Swapped");
    fails("--color-config c.ocio --display papers",
          "--display: unknown display 'papers'; did you mean 'paper'?; possible: screen, paper");
    fails("--view Plain", "--view needs an OpenColorIO configuration; name its file with --color-config");
    fails("--color-config none.ocio", "--color-config 'none.ocio': ");
    fails("--color-config broken.ocio", "--color-config 'broken.ocio': ");
    fails("--color-config c.ocio --part 1/2", "--color-config and --part cannot be combined");
    expect(d.run("render scene.toml -o a.pfm --color-config c.ocio"), 2,
           {"files of type .pfm have the intensities themselves"});
}
