// Opacity in scenes: mistakes, and where its values are shown.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

/// One texel, of 51, 102 and 255.
const std::string k_dot = std::string("P6\n1 1\n255\n\x33\x66\xff", 14);

/// A wall seen through a ball, which is seen through from both sides.
CommandResult with_material(const std::string& lines, const Folder& directory,
                            const std::string& command = "check scene.toml") {
    directory.write("scene.toml",
                    "version = 1\nimage = { width = 16, height = 8, color_management = \"none\" }\n"
                    "observer = { position = [0, 0, 4], look_at = [0, 0, 0] }\n"
                    "shading = { model = \"phong\" }\nreflection = { model = \"unlit\" }\n"
                    "[[light]]\ntype = \"ambient\"\nintensity = 1\n[[object]]\nname = \"ball\"\ntype = "
                    "\"sphere\"\ncolor = [255, 0, 0]\n[object.material]\n" +
                        lines +
                        "\n[[object]]\nname = \"wall\"\ntype = \"cube\"\nposition = [0, 0, -3]\nsize = 3\n"
                        "color = [0, 0, 255]\n");
    return directory.run(command);
}

}  // namespace

TEST_CASE("mistakes in opacity are reported at their places") {
    const Folder d({{"dot.ppm", k_dot}});
    expect(with_material("opacity = 1.5", d), 3, {"scene.toml:14:11: error: 'opacity'", "0 to 1"});
    expect(with_material("opacity_cutoff = -0.5", d), 3, {"error: 'opacity_cutoff'", "0 to 1"});
    expect(with_material("opacity_cutoff = { texture = \"dot.ppm\" }", d), 3,
           {"'opacity_cutoff' in [object.material] of 'ball' cannot have a texture"});
    expect(with_material("opacity = { texture = \"dot.ppm\", channel = \"x\" }", d), 3, {"'channel'"});
    expect(with_material("opacity = [{ texture = \"dot.ppm\" }, 0.5]", d), 3,
           {"scene.toml:14:37: error: a factor of 'opacity' in [object.material] of 'ball' is the number 0.5",
            "'scale' of one"});
    expect(with_material("opacity = [{ texture = \"dot.ppm\" }, { attribute = \"\" }]", d), 3,
           {"'attribute' of 'opacity' in [object.material] of 'ball' is empty"});
    expect(with_material("emission = [{ texture = \"dot.ppm\" }, { texture = \"dot.ppm\" }]", d), 3,
           {"'emission' in [object.material] of 'ball' cannot have 2 textures: only 'opacity' may be a "
            "product"});
    expect(with_material("alpha = 0.5", d), 3, {"'alpha'", "did you mean 'opacity'?"});
    expect(with_material("opacty = 0.5", d), 3, {"'opacty'", "did you mean 'opacity'?"});
    expect(with_material("alpha_cutoff = 0.5", d), 3, {"did you mean 'opacity_cutoff'?"});
    expect(with_material("opacity = { texture = \"dot.ppm\", channel = \"a\" }", d), 0, {});
}

TEST_CASE("explain lists the surfaces at a pixel, with what each covers") {
    const Folder d({{"dot.ppm", k_dot}});
    const char* const command = "explain scene.toml --pixel 8,4";
    const std::string text = succeeded(with_material("opacity = { texture = \"dot.ppm\" }", d, command)).out;
    CHECK(holds(text, "object 'ball', sphere: triangle"));
    CHECK(holds(text, "opacity = 0.2  texture dot.ppm\n"));
    CHECK(holds(text, "0.16 of the pixel"));
    CHECK(holds(text, "opacity = 0.2  texture dot.ppm, behind 1 surface\n"));
    CHECK(holds(text, "object 'wall', cube: triangle"));
    CHECK(holds(text, "opacity = 1  behind 2 surfaces\n"));
    CHECK(holds(text, "I = [0.36, 0, 0.64]  the sum, weighted by share of the pixel"));
    const std::string json =
        succeeded(with_material("opacity = 0.25", d, std::string(command) + " --json")).out;
    CHECK(holds(json, "\"layer\": 2"));
    CHECK(holds(json, "\"opacity\": 0.25"));
    SECTION("and no surface that is nowhere") {
        const std::string hole =
            succeeded(with_material("opacity = 0.3\nopacity_cutoff = 0.5", d, command)).out;
        CHECK_FALSE(holds(hole, "ball"));
        CHECK(holds(hole, "object 'wall', cube: triangle"));
    }
}
