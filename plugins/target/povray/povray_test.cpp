// POV-Ray scenes, drawn by POV-Ray.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/floor_scene.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

CommandResult generate(const Folder& folder, const std::string& scene,
                       const std::vector<std::string>& more = {}) {
    folder.write("scene.toml", scene);
    return folder.run("generate scene.toml --target povray -o made", more);
}

std::string generated(const Folder& folder, const std::string& scene) {
    succeeded(generate(folder, scene));
    return folder.read("made/scene.pov");
}

/// The middle pixel of the picture that POV-Ray draws, in levels.
std::array<int, 3> drawn_in_the_middle(const Folder& folder, const std::string& scene) {
    generated(folder, scene);
    CommandSetup setup{.directory = folder / "made"};
    succeeded(run_program({"povray", "scene.ini", "+FP", "+Opicture.ppm"}, setup));
    return read_ppm(folder / "made/picture.ppm").middle();
}

std::array<int, 3> levels(double r, double g, double b) {
    const auto level = [](double x) { return static_cast<int>(std::lround(255 * x)); };
    return {level(r), level(g), level(b)};
}

const std::string k_head = "version = 1\nshading = {model = \"phong\"}\n";

/// The output of `candela verify` for a scene, with a tolerance of one level.
CommandResult verify(const Folder& folder, const std::string& scene,
                     const std::vector<std::string>& more = {}) {
    folder.write("scene.toml", scene);
    return folder.run("verify scene.toml --target povray --tolerance 1", more);
}

}  // namespace

TEST_CASE("target/povray: POV-Ray draws RE example 2: cos theta is 0.7071, cos alpha 0.8575") {
    const Folder folder({{"floor.obj", k_floor_obj}});
    CHECK(drawn_in_the_middle(folder, floor_scene("lambert", "ka = 0\nkd = 1\n")) ==
          levels(0.7071, 0.7071, 0.7071));
    CHECK(drawn_in_the_middle(folder, floor_scene("phong", "ka = 0\nkd = 0\nks = 1\nshininess = 1\n")) ==
          levels(0.8575, 0.8575, 0.8575));
    // Half of the angle between R and V is that between N and H: cos(arccos(0.8575) / 2) = 0.9637.
    CHECK(
        drawn_in_the_middle(folder, floor_scene("blinn-phong", "ka = 0\nkd = 0\nks = 1\nshininess = 1\n")) ==
        levels(0.9637, 0.9637, 0.9637));
}

TEST_CASE(
    "target/povray: POV-Ray draws RE example 3, corrected, with coefficients that differ between channels") {
    const Folder folder;
    // With the note's normal, which is not quite that of its face.
    folder.write("face.obj",
                 "v .7 .1 .4\nv .1 .2 .2\nv .3 .5 .5\nvn .33333333 .66666667 -.66666667\nf 1//1 2//1 3//1\n");
    // A millimetre from V1 within the face, seen along z from the side of -z.
    const std::string scene =
        k_head +
        R"(observer = {position = [0.699, 0.1005, -3], look_at = [0.699, 0.1005, 0], projection = "orthographic", height = 1e-4}
image = {width = 9, height = 9, color_management = "none"}
reflection = {model = "phong"}
[[light]]
type = "point"
position = [0.3, 0.8, 0.4]
attenuation = "offset-linear"
attenuation_offset = 0.01
[[light]]
type = "ambient"
color = [255, 170, 85]
intensity = 0.3
[[object]]
type = "mesh"
file = "face.obj"
color = [255, 255, 255]
[object.material]
ka = 0.1
kd = [0.8, 0.8, 0.9]
ks = [0.2, 0.2, 0.1]
shininess = 10
)";
    // kd 0.4135 / 0.8162 + ka I_a, and ks 0.5514^10 / 0.8162; a millimetre away it is the same to within a
    // level.
    const std::array<int, 3> drawn = drawn_in_the_middle(folder, scene);
    const std::array<int, 3> expected = levels(0.4353 + 0.0006, 0.4253 + 0.0006, 0.4660 + 0.0003);
    INFO(fmt::format("{} {} {}", drawn[0], drawn[1], drawn[2]));
    for (std::size_t k = 0; k < 3; ++k) CHECK(std::abs(drawn[k] - expected[k]) <= 1);
}

TEST_CASE("target/povray: camera, spot and background match figures computed by hand") {
    const std::string text =
        generated(Folder(), k_head + R"(observer = {position = [0, 0, 4], look_at = [0, 0, 0], fov = 90}
image = {width = 200, height = 100, background = [255, 0, 255]}
reflection = {model = "lambert"}
[[light]]
type = "spot"
position = [0, 4, 0]
direction = [0, -2, 0]
inner_angle = 15
outer_angle = 30
intensity = 7
[[object]]
type = "sphere"
)");
    // 2 tan 45 degrees high, and twice as wide.
    CHECK(holds(text, "location <0, 0, 4>"));
    CHECK(holds(text, "direction <-0, -0, -1>"));
    CHECK(holds(text, "right <4, 0, 0>"));
    CHECK(holds(text, "up <0, 2, 0>"));
    CHECK(holds(text, "background { rgb <1, 0, 1> }"));
    CHECK(holds(text,
                "rgb 7 / (2 * Near * Near) fade_distance Near fade_power 2 spotlight point_at <0, 3, 0>"));
    const std::size_t radius = text.find("radius ") + 7, falloff = text.find("falloff ") + 8;
    CHECK(std::abs(std::stod(text.substr(radius)) - 15) < 1e-4);
    CHECK(std::abs(std::stod(text.substr(falloff)) - 30) < 1e-4);
}

TEST_CASE("target/povray: a coarse ball is correct where its normals point away from the observer") {
    const CommandResult result =
        verify(Folder(), k_head + R"(observer = {position = [0, 0, 2.5], look_at = [0, 0, 0]}
image = {width = 200, height = 150, background = [0, 0, 90]}
reflection = {model = "lambert"}
[[light]]
type = "directional"
direction = [1, -0.5, 0.8]
[[object]]
type = "sphere"
segments = 6
radius = 0.8
)");
    INFO(result.out);
    CHECK(result.err.empty());
    CHECK(result.exit_code == 0);
}

TEST_CASE("target/povray: a triangle keeps normals that equal each other but not the face's") {
    const Folder folder;
    folder.write(
        "leaning.obj",
        "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0.6 0 0.8\nf 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
    expect(verify(folder, k_head + R"(observer = {position = [0, 0, 3], look_at = [0, 0, 0]}
image = {width = 100, height = 80}
reflection = {model = "blinn-phong"}
[[light]]
type = "point"
position = [2, 1, 3]
intensity = 9
[[object]]
type = "mesh"
file = "leaning.obj"
)"),
           0);
}

TEST_CASE("target/povray: colours at vertices match Candela's, even through a tinted highlight") {
    const Folder folder;
    folder.write("colors.obj",
                 "v -1 -1 0 1 0 0\nv 1 -1 0 0 1 0\nv 1 1 0 0 0 1\nv -1 1 0 1 1 0.5\nvn 0 0 1\n"
                 "f 1//1 2//1 3//1\nf 1//1 3//1 4//1\n");
    for (const std::string& highlight : {std::string("0.3"), std::string("[0.3, 0.2, 0.1]")}) {
        expect(verify(folder, k_head + R"(observer = {position = [0.3, 0.2, 3], look_at = [0, 0, 0]}
image = {width = 120, height = 90}
reflection = {model = "phong"}
[[light]]
type = "point"
position = [1, 1, 3]
intensity = 9
[[object]]
type = "mesh"
file = "colors.obj"
color = [250, 200, 220]
[object.material]
kd = 0.7
ks = )" + highlight),
               0);
    }
}

TEST_CASE("target/povray: a texture is only approximate, but correct where a texel is larger than a pixel") {
    const Folder folder;
    std::string texels = "P6\n8 8\n255\n";
    for (int i = 0; i < 64; ++i) {
        texels += static_cast<char>(i % 8 * 36);
        texels += static_cast<char>(i / 8 * 36);
        texels += static_cast<char>((i / 2 + i / 16) % 2 * 255);
    }
    folder.write("texture.ppm", texels);
    // One material has its color in the pigment, the other below a filter, and both have normals that turn
    // away.
    const std::string scene = k_head + R"(observer = {position = [0, 0, 3.4], look_at = [0, 0, 0]}
image = {width = 240, height = 120, background = [0, 0, 90]}
reflection = {model = "blinn-phong"}
[[light]]
type = "directional"
direction = [1, -0.5, -0.8]
[[object]]
type = "sphere"
segments = 10
radius = 0.8
position = [-1, 0, 0]
color = { texture = "texture.ppm", scale = [0.6, 0.95, 0.7], transform = { scale = [2, 1.5], rotation = 30, offset = [0.2, 0.1] } }
[[object]]
type = "sphere"
segments = 10
radius = 0.8
position = [1, 0, 0]
color = { texture = "texture.ppm" }
[object.material]
kd = [0.5, 0.4, 0.6]
ks = [0.4, 0.2, 0.1]
)";
    expect(generate(folder, scene), 1, {"textures are seen bilinear"});
    const std::string encoding = GENERATE(as<std::string>(), "srgb", "none");
    expect(verify(folder, scene, {"--approximate", "--set=image.color_management=\"" + encoding + '"'}), 0);
}

TEST_CASE("target/povray: a parameter's texture becomes its mean, if the user accepts that") {
    const Folder folder({{"wall.obj",
                          "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                          "f 1/1 2/2 3/3 4/4\n"}});
    // Of 0.4 and 0.9, because 0.1 + 255 / 255 is clamped: 0.1 + 77 / 255.
    folder.write("p.ppm", std::string("P6\n2 1\n255\n") + '\x4d' + std::string(2, '\0') + '\xff' +
                              std::string(2, '\0'));
    const std::string scene = k_head + R"(observer = {position = [0, 0, 3], look_at = [0, 0, 0]}
reflection = {model = "lambert"}
[[light]]
type = "directional"
direction = [0, 0, -1]
[[object]]
name = "wall"
type = "mesh"
file = "wall.obj"
color = [255, 255, 255]
[object.material]
ka = 0
kd = { texture = "p.ppm", channel = "r", offset = 0.1 }
)";
    expect(generate(folder, scene), 1, {"the texture of 'kd' of object wall becomes its mean"});
    succeeded(folder.run("generate scene.toml --target povray -o made --approximate --quiet"));
    CHECK(holds(folder.read("made/scene.pov"), "diffuse 0.70098"));
}

TEST_CASE(
    "target/povray: with shadows, light is blocked where it enters a solid object, and on both sides of an "
    "open one") {
    const Folder folder({{"floor.obj", "v -3 -1 -3\nv -3 -1 3\nv 3 -1 3\nv 3 -1 -3\nf 1 2 3 4\n"}});
    // A coarse ball whose normals face lights that its triangles do not, a lamp within a solid one, whose
    // light leaves it, and a sheet with a lamp on either side.
    expect(verify(folder, k_head + R"(observer = {position = [0.3, 1.4, 4.5], look_at = [0, -0.2, 0]}
image = {width = 240, height = 180, background = [0, 0, 90]}
reflection = {model = "phong"}
shadows = {enabled = true}
[[light]]
type = "point"
position = [-2, 2, 1]
intensity = 4
[[light]]
type = "point"
position = [1, 0.3, -0.6]
intensity = 1
[[light]]
type = "directional"
direction = [-1, -0.5, 0.2]
intensity = 0.3
[[object]]
type = "mesh"
file = "floor.obj"
[[object]]
type = "sphere"
segments = 7
radius = 0.6
position = [-0.9, -0.2, 0.3]
[[object]]
type = "cube"
size = 0.6
encloses = true
position = [1, 0.3, -0.6]
[[object]]
type = "mesh"
file = "floor.obj"
scale = [0.1, 0.5, 0.2]
rotation = [80, 20, 0]
position = [0.3, -0.1, 0.3]
)"),
           0);
}

TEST_CASE("target/povray: lights and objects without shadows keep their cones and highlights") {
    const Folder folder({{"floor.obj", "v -3 -1 -3\nv -3 -1 3\nv 3 -1 3\nv 3 -1 -3\nf 1 2 3 4\n"}});
    expect(verify(folder, k_head + R"(observer = {position = [0.3, 1.4, 4.5], look_at = [0, -0.2, 0]}
image = {width = 240, height = 180, background = [0, 0, 90]}
reflection = {model = "phong"}
shadows = {enabled = true}
[[light]]
type = "spot"
position = [-1, 2.5, 1]
direction = [0.4, -1, -0.3]
intensity = 6
outer_angle = 40
inner_angle = 20
casts_shadows = false
[[light]]
type = "directional"
direction = [-1, -0.7, -0.4]
intensity = 0.4
[[object]]
type = "mesh"
file = "floor.obj"
[[object]]
type = "sphere"
radius = 0.5
position = [-0.4, 0.6, 0.3]
casts_shadows = false
[[object]]
type = "sphere"
radius = 0.5
position = [0.7, 0.1, 0]
[[object]]
type = "cube"
size = 0.8
position = [-0.5, -0.5, -0.3]
rotation = [0, 30, 0]
receives_shadows = false
)"),
           0);
}

TEST_CASE("target/povray: what differs in POV-Ray's shadows is refused by name") {
    const Folder folder;
    const std::string scene = k_head + R"(observer = {position = [0, 0, 4], look_at = [0, 0, 0]}
image = {width = 64, height = 48}
reflection = {model = "lambert"}
shadows = {enabled = true}
[[light]]
name = "sky"
type = "ambient"
ambient_occlusion_rays = 8
[[light]]
name = "tube"
type = "distributed"
position = [0, 2, 1]
[[object]]
name = "pot"
type = "teapot"
size = 0.5
position = [1, 0, 0]
[[object]]
name = "ring"
type = "torus"
major_radius = 0.3
minor_radius = 0.1
receives_shadows = false
[[object]]
name = "tire"
type = "torus"
major_radius = 0.3
minor_radius = 0.1
position = [-1, 0, 0]
)";
    const CommandResult refused = generate(folder, scene);
    CHECK(refused.exit_code == 1);
    for (const char* const sentence :
         {"light 'sky' is not darkened by what is near",
          "light 'tube' has as many steps in its penumbras as it has samples", "object pot is open",
          "object ring is not convex", "object tire is hollow in places"}) {
        INFO(sentence);
        CHECK(holds(refused.err, sentence));
    }
    expect(generate(folder, scene, {"--approximate"}), 0);
    expect(generate(folder, scene, {"--no-shadows"}), 0);
}

TEST_CASE("target/povray: a scene of a few millimetres is too small for its shadows") {
    const CommandResult refused =
        generate(Folder(), k_head + R"(observer = {position = [0, 0, 0.02], look_at = [0, 0, 0]}
image = {width = 64, height = 48}
reflection = {model = "lambert"}
shadows = {enabled = true}
[[light]]
type = "directional"
direction = [0, -1, 0]
[[object]]
type = "sphere"
radius = 0.005
)");
    CHECK(refused.exit_code == 1);
    CHECK(holds(refused.err, "nearer than a millimetre"));
}

TEST_CASE("target/povray: a principled material has the highlight of its metallic share and roughness") {
    const auto finish = [](const std::string& values, const std::string& model = "disney") {
        const Folder folder;
        succeeded(generate(folder,
                           k_head + R"(observer = {position = [0, 0, 4], look_at = [0, 0, 0]}
image = {width = 64, height = 48}
[[light]]
type = "directional"
direction = [0, -1, 0]
[[object]]
type = "sphere"
color = [255, 255, 255]
reflection = ")" + model + "\"\nmaterial = {" +
                               values + "}\n",
                           {"--approximate"}));
        return folder.read("made/scene.pov");
    };
    // A roughness of 0.5 is an alpha of 0.25: F / (4 alpha^2) = 4 F, and an exponent of 2 / alpha^2 - 2 = 30.
    CHECK(holds(finish("metallic = 1"), "diffuse 0 specular 4 roughness 0.03333"));
    CHECK(holds(finish("specular = 1"), "diffuse 1 specular 0.32 roughness 0.03333"));
    CHECK(holds(finish("specular_color = 0.25, glossiness = 0.5", "specular-glossiness"),
                "diffuse 0.75 specular 1 roughness 0.03333"));
    CHECK(holds(finish("specular = 0.5", "metallic-roughness"),
                "diffuse 1 specular 0.080000006 roughness 0.03333"));
    CHECK(holds(finish("base_color = 0.5, base_metalness = 1, specular_roughness = 0.5", "openpbr"),
                "diffuse 0 specular 2 roughness 0.03333"));
}

TEST_CASE(
    "target/povray: features that POV-Ray lacks are refused by name, or reported once each with "
    "--approximate") {
    const std::string scene = k_head + R"(observer = {position = [0, 0, 4], look_at = [0, 0, 0]}
image = {width = 64, height = 48}
reflection = {model = "ggx"}
[[light]]
type = "hemisphere"
[[light]]
type = "spot"
position = [0, 3, 0]
direction = [0, -1, 0]
falloff = "linear"
[[object]]
type = "sphere"
position = [-1, 0, 0]
[[object]]
type = "sphere"
position = [1, 0, 0]
[[object]]
type = "cube"
size = 0.3
shading = "flat"
)";
    const Folder folder;
    const CommandResult refused = generate(folder, scene);
    CHECK(refused.exit_code == 1);
    CHECK_FALSE(folder.has("made"));
    const CommandResult accepted = generate(folder, scene, {"--approximate"});
    CHECK(accepted.exit_code == 0);
    CHECK(folder.has("made/scene.pov"));
    for (const std::string& name : {"reflection/ggx", "light/hemisphere", "light/spot", "shading/flat"}) {
        INFO(name);
        CHECK(holds(refused.err, name));
        CHECK(count_of(accepted.err, name) == 1);
    }
    CHECK(holds(refused.err, "--approximate"));
}

TEST_CASE("target/povray: light, ambient light and emission are exposed, the background is not") {
    // 1/(1.2 * 2^EV) = 1/1000.
    const std::string view =
        "observer = {position = [0, 0, 4], look_at = [0, 0, 0], exposure = 9.7027499}\n"
        "reflection = {model = \"phong\"}\n"
        "[[light]]\ntype = \"ambient\"\nintensity = 100\n"
        "[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\nintensity = 200\n";
    const Folder folder({{"wall.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n"}});
    const std::string image = "image = {width = 9, height = 9, color_management = \"none\"}\n";
    CHECK(drawn_in_the_middle(
              folder, k_head + image + view +
                          "[[object]]\ntype = \"mesh\"\nfile = \"wall.obj\"\ncolor = [255, 255, 255]\n"
                          "[object.material]\nka = 0.5\nkd = 0.6\nks = 0\nemission = [255, 0, 0]\n"
                          "emission_strength = 150\n") == levels(0.05 + 0.12 + 0.15, 0.17, 0.17));
    const CommandResult same =
        verify(folder, k_head + "image = {width = 96, height = 72, background = [51, 102, 204]}\n" + view +
                           "[[light]]\ntype = \"point\"\nposition = [0.3, 0.5, 3]\nintensity = 900\n"
                           "[[object]]\ntype = \"sphere\"\nradius = 0.8\nsegments = 64\n"
                           "[object.material]\nks = 0.3\nemission = [255, 0, 0]\nemission_strength = 150\n");
    INFO(same.out << same.err);
    CHECK(same.exit_code == 0);
}
