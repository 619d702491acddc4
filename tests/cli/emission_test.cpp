// Emission and occlusion in scenes: mistakes, and where their values are shown.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

/// One texel, of 51, 102 and 255.
const std::string k_dot = std::string("P6\n1 1\n255\n\x33\x66\xff", 14);

CommandResult with_material(const std::string& lines, const Folder& directory,
                            const std::string& command = "check scene.toml") {
    directory.write("scene.toml",
                    "version = 1\nimage = { width = 16, height = 8, color_management = \"none\" }\n"
                    "observer = { position = [0, 0, 4], look_at = [0, 0, 0] }\n"
                    "shading = { model = \"phong\" }\nreflection = { model = \"phong\" }\n"
                    "[[light]]\ntype = \"ambient\"\n[[object]]\nname = \"ring\"\ntype = \"torus\"\n"
                    "[object.material]\n" +
                        lines + "\n");
    return directory.run(command);
}

}  // namespace

TEST_CASE("mistakes in emission and occlusion are reported at their places") {
    const Folder d({{"dot.ppm", k_dot}});
    expect(with_material("emission = [300, 0, 0]", d), 3, {"scene.toml:12:12: error: 'emission'", "255"});
    expect(with_material("emission = 3", d), 3, {"scene.toml:12:12: error: 'emission' is the integer 3"});
    expect(with_material("emission_strength = -1.0", d), 3,
           {"scene.toml:12:21: error: 'emission_strength'", "at least 0"});
    expect(with_material("emission_strength = { texture = \"dot.ppm\" }", d), 3,
           {"scene.toml:12:21: error: 'emission_strength' in [object.material] of 'ring' cannot have a "
            "texture"});
    expect(with_material("occlusion = 1.5", d), 3, {"scene.toml:12:13: error: 'occlusion'", "0 to 1"});
    expect(with_material("occlusion = { texture = \"dog.ppm\" }", d), 3,
           {"scene.toml:12:25: error: 'dog.ppm' does not exist", "did you mean 'dot.ppm'?"});
    expect(with_material("occlusion = { texture = \"dot.ppm\", scale = [1, 2, 3] }", d), 3,
           {"'scale' of 'occlusion' in [object.material] of 'ring' has three numbers"});
    expect(with_material("emissive = [1, 2, 3]", d), 3, {"'emissive'", "did you mean 'emission'?"});
    expect(with_material("emision = [1, 2, 3]", d), 3, {"'emision'", "did you mean 'emission'?"});
    expect(with_material("ao = 0.5", d), 3, {"did you mean 'occlusion'?"});
    expect(with_material("emission = [1, 2, 3]\nemission_strength = 1e6\nocclusion = 0", d), 0, {});
}

TEST_CASE("explain shows what a point emits and the occlusion of its ambient light, with their texels") {
    const Folder d({{"dot.ppm", k_dot}});
    const char* const command = "explain scene.toml --pixel 8,4";
    const std::string textured = succeeded(with_material("emission = { texture = \"dot.ppm\" }\n"
                                                         "emission_strength = 2\nka = 0.5\n"
                                                         "occlusion = { texture = \"dot.ppm\" }",
                                                         d, command))
                                     .out;
    CHECK(holds(textured, "I_e = [0.4, 0.8, 2]  emission: texel (0, 0) of dot.ppm, emission_strength 2\n"));
    CHECK(holds(textured, "occlusion = 0.2  texel (0, 0) of dot.ppm\n"));
    CHECK(holds(textured, "I_a + I_d + I_s + I_e"));
    // Half of C_o, which is 200 of 255, of ambient light of 1: the occlusion makes it a fifth.
    CHECK(holds(textured, "I_a = [0.0784314, 0.0784314, 0.0784314]"));
    CHECK(holds(textured, "I = [0.478431, 0.878431, 2.07843]"));
    const std::string plain = succeeded(with_material("emission = [51, 0, 0]", d, command)).out;
    CHECK(holds(plain, "I_e = [0.2, 0, 0]  emission\n"));
    CHECK_FALSE(holds(plain, "occlusion"));
    CHECK_FALSE(holds(succeeded(with_material("ka = 0.5", d, command)).out, "I_e"));
}

TEST_CASE("emission is a term, adds to no light, and can be set and animated") {
    const Folder d;
    const std::string material = "ka = 0.5\nemission = [51, 0, 0]\nemission_strength = 1";
    succeeded(with_material(material, d,
                            "render scene.toml --set object.ring.material.emission_strength=2 --terms "
                            "ambient,emission,light -o out.exr"));
    expect(with_material(material +
                             "\n[animation]\nframes = 2\n[[animation.track]]\npath = "
                             "\"object.ring.material.emission_strength\"\nkeys = [[0.0, 0.0], [1.0, 4.0]]",
                         d),
           0, {});
    expect(
        with_material(material + "\n[animation]\nframes = 2\n[[animation.track]]\npath = "
                                 "\"object.ring.material.emision_strength\"\nkeys = [[0.0, 0.0], [1.0, 4.0]]",
                      d),
        3, {"emission_strength"});
}
