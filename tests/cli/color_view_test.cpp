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
