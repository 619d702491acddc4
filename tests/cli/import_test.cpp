// Models in place of scenes, and the scenes made by candela import.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <numbers>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// Two squares side by side that face +z, each two metres wide: at x = -1 with the material "left", at x = 1
/// with "right side".
constexpr const char* k_squares =
    "mtllib two.mtl\nv -2 -1 0\nv 0 -1 0\nv 0 1 0\nv -2 1 0\nv 2 -1 0\nv 2 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 "
    "1\n"
    "vn 0 0 1\nusemtl left\nf 1/1/1 2/2/1 3/3/1 4/4/1\nusemtl right side\nf 2/1/1 5/2/1 6/3/1 3/4/1\n";
constexpr const char* k_two_materials =
    "newmtl left\nKa 0.1 0.2 0.3\nKd 0.8 0.4 0.2\nKs 0.2 0.2 0.2\nNs 25\nillum 2\n"
    "newmtl right side\nKd 0.1 0.6 0.1\nillum 1\nd 0.5\n";

std::string grey_ppm(std::uint8_t value) {
    return std::string("P6\n1 1\n255\n") + std::string(3, static_cast<char>(value));
}

std::string base64(const std::string& bytes) {
    constexpr const char* k_digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t word = 0;
        for (std::size_t k = 0; k < 3; ++k)
            word = word << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : k_digits[word >> (18 - 6 * k) & 63];
    }
    return text;
}

/// A glTF file of one triangle in z = 0, with additional contents.
std::string gltf(const std::string& node_and_more, const std::string& primitive = "") {
    const std::array<float, 9> position = {-1, -1, 0, 1, -1, 0, 0, 1, 0};
    const std::array<float, 6> uv = {0, 1, 1, 1, 0.5f, 0};
    std::string bytes(sizeof position + sizeof uv, '\0');
    std::memcpy(bytes.data(), position.data(), sizeof position);
    std::memcpy(bytes.data() + sizeof position, uv.data(), sizeof uv);
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "scenes": [{{"nodes": [0, 1, 2]}}], "scene": 0,
"buffers": [{{"byteLength": {}, "uri": "data:application/octet-stream;base64,{}"}}],
"bufferViews": [{{"buffer": 0, "byteOffset": 0, "byteLength": 36}}, {{"buffer": 0, "byteOffset": 36, "byteLength": 24}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}},
              {{"bufferView": 1, "componentType": 5126, "count": 3, "type": "VEC2"}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0, "TEXCOORD_0": 1}}{}}}]}}],
{}}})",
        bytes.size(), base64(bytes), primitive, node_and_more);
}

constexpr const char* k_plain_nodes = R"("nodes": [{"mesh": 0}, {}, {}])";

}  // namespace

TEST_CASE("a model in place of a scene is framed: it is completely visible, lit and centred") {
    const Folder folder;
    // A cube of 200 metres, 1000 metres away from the origin.
    std::string text;
    for (int i = 0; i < 8; ++i)
        text +=
            fmt::format("v {} {} {}\n", 900 + 200 * (i & 1), 900 + 200 * (i >> 1 & 1), 900 + 200 * (i >> 2));
    text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    folder.write("cube.obj", text);
    const CommandResult result = succeeded(folder.run("render cube.obj -o cube.ppm"));
    CHECK_FALSE(holds(result.err, "warning"));
    const Ppm picture = read_ppm(folder / "cube.ppm");
    CHECK(picture.covered() > 0.2);
    CHECK(picture.at(picture.width / 2, picture.height / 2)[1] > 60);
    CHECK(picture.has_free_border());
}

TEST_CASE("a model is completely visible in pictures of every proportion, also through its scene") {
    const Folder folder;
    std::string text;
    for (int i = 0; i < 8; ++i)
        text += fmt::format("v {} {} {}\n", 4 * (i & 1 ? 1 : -1), i >> 1 & 1 ? 1 : -1,
                            0.3 * (i >> 2 != 0 ? 1 : -1));
    text += "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n";
    folder.write("box.obj", text);
    succeeded(folder.run("import box.obj -o scene.toml"));
    for (const char* const input : {"box.obj", "scene.toml"}) {
        for (const auto& [width, height] :
             {std::pair{"300", "300"}, {"300", "600"}, {"60", "900"}, {"600", "300"}, {"900", "60"}}) {
            INFO(input << " at " << width << " x " << height);
            succeeded(
                folder.run_words({"render", input, "-o", "box.ppm", "--width", width, "--height", height}));
            const Ppm picture = read_ppm(folder / "box.ppm");
            CHECK(picture.covered() > 0.01);
            CHECK(picture.has_free_border());
        }
    }
    // A wide model fills a narrow picture from side to side.
    succeeded(folder.run("render scene.toml -o box.ppm --set image.width=300"));
    const Ppm picture = read_ppm(folder / "box.ppm");
    int first = picture.width, last = 0;
    for (int x = 0; x < picture.width; ++x)
        for (int y = 0; y < picture.height; ++y)
            if (picture.at(x, y) != picture.at(0, 0)) first = std::min(first, x), last = std::max(last, x);
    CHECK(last - first > picture.width * 8 / 10);
}

TEST_CASE("import writes the scene that render shows: both make the same picture") {
    const Folder folder;
    fs::create_directory(folder / "models");
    write_file(folder / "models" / "two.obj", k_squares);
    write_file(folder / "models" / "two.mtl", std::string(k_two_materials) + "map_Kd grey.ppm\n");
    write_file(folder / "models" / "grey.ppm", grey_ppm(120));
    succeeded(folder.run("render models/two.obj -o a.ppm"));
    const CommandResult import = folder.run("import models/two.obj -o models/scene.toml");
    INFO(import.err);
    REQUIRE(import.exit_code == 0);
    CHECK(holds(import.err, "2 objects, 3 lights, 1 texture"));
    // The scene can be moved together with the model.
    fs::rename(folder / "models", folder / "moved");
    const CommandResult render = succeeded(folder.run("render moved/scene.toml -o b.ppm"));
    CHECK_FALSE(holds(render.err, "warning"));
    CHECK(folder.read("a.ppm") == folder.read("b.ppm"));
}

TEST_CASE("import translates an MTL file's Phong parameters, and reports each loss once") {
    const Folder folder;
    folder.write("two.obj", k_squares);
    folder.write("two.mtl", k_two_materials);
    const CommandResult result = folder.run("import two.obj -o -");
    REQUIRE(result.exit_code == 0);
    CHECK(holds(result.out, "name                = \"left\"\n"));
    CHECK(holds(result.out, "part                = \"right side\"\n"));
    CHECK(holds(result.out,
                "[object.material]\nka        = [0.1, 0.2, 0.3]\nkd        = [0.8, 0.4, 0.2]\n"
                "ks        = 0.2\nshininess = 25.0\n"));
    // Without highlights: illumination model 1.
    CHECK(holds(result.out, "kd        = [0.1, 0.6, 0.1]\nks        = 0.0\n"));
    CHECK(result.err.empty());
    CHECK(holds(result.out, "opacity   = 0.5\n"));
    SECTION("each part has its own colour in the picture") {
        succeeded(folder.run("render two.obj -o a.ppm"));
        const Ppm picture = read_ppm(folder / "a.ppm");
        const auto left = picture.at(picture.width / 3, picture.height / 2);
        const auto right = picture.at(picture.width * 2 / 3, picture.height / 2);
        CHECK(left[0] > left[1]);
        CHECK(right[1] > right[0]);
    }
}

TEST_CASE("import reports missing libraries, materials and textures, and goes on") {
    const Folder folder({{"two.obj", k_squares}});
    CommandResult result = expect(folder.run("render two.obj -o a.ppm"), 0,
                                  {"2 materials are not in any material library, the first of them 'left'"});
    folder.write("two.mtl",
                 "newmtl left\nmap_Kd -t 2 2 2 -clamp on no such.png\nnewmtl right side\nmap_Kd a.xyz\n");
    folder.write("a.xyz", "what?");
    result = folder.run("render two.obj -o a.ppm");
    CHECK(result.exit_code == 0);
    CHECK(holds(result.err, "the texture 'no such.png' of material 'left' does not exist"));
    CHECK(
        holds(result.err,
              "the texture 'a.xyz' of material 'right side' is left out: no image plugin reads its format"));
    CHECK(holds(result.err, "the turbulence and the range of textures are left out"));
}

TEST_CASE("materials whose names are not UTF-8 are distinguished by their numbers") {
    const Folder folder;
    folder.write("a.obj",
                 "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl never\nusemtl \xe9\nf 1 2 3\nusemtl b\nf 1 3 2\n");
    expect_out(folder.run("import a.obj -o -"), 0,
               {"part                = \"#1\"\n", "part                = \"b\"\n"});
    expect(folder.run("render a.obj -o a.ppm"), 0);
}

TEST_CASE("files outside its folder that an OBJ file names are not opened") {
    const Folder folder;
    fs::create_directory(folder / "model");
    folder.write("secret.mtl", "newmtl left\nKd 1 0 0\n");
    folder.write("secret.ppm", grey_ppm(7));
    write_file(folder / "model" / "two.obj",
               "mtllib ../secret.mtl\nmtllib two.mtl\n" + std::string(k_squares));
    write_file(folder / "model" / "two.mtl", "newmtl left\nmap_Kd ../secret.ppm\nnewmtl right side\n");
    const CommandResult result =
        expect(folder.run("import model/two.obj -o -"), 0,
               {"secret.mtl' is outside the model's folder",
                "the texture '../secret.ppm' of material 'left' is outside the model's folder"});
    CHECK_FALSE(holds(result.out, "texture ="));
}

TEST_CASE("an invalid or hostile MTL file leaves the model unchanged") {
    for (const std::string& library :
         {std::string("\0\1\2\xff\xfe newmtl", 12),
          std::string("newmtl\nKd\nKd x y z\nKd 1e999 nan -3\nNs -5\nillum 99\n"),
          std::string("Kd 1 1 1\nmap_Kd\n"),
          "newmtl left\nmap_Kd -s -o -t\nKd spectral a.rfl\n" + std::string(100000, '-'),
          "newmtl left\nmap_Kd /dev/zero\nKd 5 5 5\n" + std::string(50000, '\n')}) {
        const Folder folder;
        folder.write("two.obj", k_squares);
        folder.write("two.mtl", library);
        const CommandResult result = folder.run("render two.obj -o a.ppm");
        INFO(library.substr(0, 60) << '\n' << result.err);
        CHECK(result.exit_code == 0);
    }
}

TEST_CASE("import translates a glTF file's camera, lights and metallic-roughness materials") {
    const Folder folder;
    folder.write("a.gltf", gltf(R"("nodes": [{"mesh": 0}, {"camera": 0, "translation": [0, 0.5, 4]},
  {"translation": [0, 2, 3], "rotation": [-0.7071068, 0, 0, 0.7071068], "extensions": {"KHR_lights_punctual": {"light": 0}}}],
"cameras": [{"type": "perspective", "perspective": {"yfov": 0.5235988, "aspectRatio": 2, "znear": 0.1}}],
"extensions": {"KHR_lights_punctual": {"lights": [{"type": "spot", "name": "beam", "intensity": 31.4159265, "color": [1, 0.2158605, 0],
  "spot": {"innerConeAngle": 0.1745329, "outerConeAngle": 0.5235988}}]}},
"materials": [{"name": "gold", "normalTexture": {"index": 0}, "pbrMetallicRoughness":
  {"baseColorFactor": [1, 0.5, 0.25, 1], "metallicFactor": 1, "roughnessFactor": 0.5}}])",
                                R"(, "material": 0)"));
    const CommandResult result = succeeded(folder.run("import a.gltf -o -"));
    INFO(result.out);
    CHECK(holds(result.out,
                "position     = [0.0, 0.5, 4.0]\nlook_at      = [0.0, 0.5, 0.0]\nfov          = 30.0\n"));
    CHECK(holds(result.out, "width      = 1200\nheight     = 600\n"));
    // A node turned by -90 degrees about x shines along -y. 0.2158605 is 128 in sRGB.
    CHECK(
        holds(result.out,
              "name        = \"beam\"\ntype        = \"spot\"\ncolor       = [255, 128, 0]\n"
              "intensity   = \"31.4159 cd\"\nposition    = [0.0, 2.0, 3.0]\ndirection   = [0.0, -1.0, 0.0]\n"
              "inner_angle = 10.0\nouter_angle = 30.0\n"));
    CHECK(holds(result.out, "metallic  = 1.0\nroughness = 0.5\n"));
    CHECK(holds(result.err, "the picture of a texture of material 'gold' is missing"));
    expect(folder.run("render a.gltf -o a.ppm"), 0);
}

TEST_CASE("a texture inside a glTF file is written next to the scene, and render shows it without that") {
    const Folder folder;
    folder.write("grey.toml", k_start + image_table(2, 2) + "background = [10, 200, 30]\n" + k_models);
    succeeded(folder.run("render grey.toml -o green.png"));
    folder.write("a.gltf",
                 gltf(fmt::format(R"({}, "images": [{{"name": "leaf", "uri": "data:image/png;base64,{}"}}],
"textures": [{{"source": 0, "sampler": 0}}], "samplers": [{{"wrapS": 33071, "wrapT": 33071}}],
"materials": [{{"pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}, "metallicFactor": 0}}}}])",
                                  k_plain_nodes, base64(folder.read("green.png"))),
                      R"(, "material": 0)"));
    const CommandResult import = succeeded(folder.run("import a.gltf"));
    CHECK(read_file(folder / "a_textures" / "leaf_0.png") == folder.read("green.png"));
    CHECK(holds(folder.read("a.toml"),
                "color               = { texture = \"a_textures/leaf_0.png\", wrap = \"clamp\" }\n"));
    succeeded(folder.run("render a.toml -o b.ppm"));
    succeeded(folder.run("render a.gltf -o a.ppm"));
    CHECK(folder.read("a.ppm") == folder.read("b.ppm"));
    const Ppm picture = read_ppm(folder / "a.ppm");
    const auto middle = picture.at(picture.width / 2, picture.height / 2);
    CHECK(middle[1] > 2 * middle[0]);
    CHECK(middle[1] > 2 * middle[2]);
    expect(folder.run("import a.gltf"), 1);  // it exists already
    expect(folder.run("import a.gltf --force"), 0);
    // A link in place of the folder, whose name Candela chooses, is not followed.
    fs::remove(folder / "a_textures" / "leaf_0.png");
    fs::rename(folder / "a_textures", folder / "elsewhere");
    fs::create_directory_symlink("elsewhere", folder / "a_textures");
    CHECK(holds(folder.run("import a.gltf --force").err, "a_textures' cannot be created: a link"));
    CHECK(fs::is_empty(folder / "elsewhere"));
}

TEST_CASE("textures of a glTF file that are broken, elsewhere or endless are left out with a reason") {
    const Folder folder;
    struct Case {
        const char* image;
        const char* reason;
    };
    for (const Case& wrong :
         {Case{R"({"uri": "no.png"})", "'no.png' does not exist"},
          Case{R"({"uri": "../../../../../../etc/passwd"})", "is outside the model's folder"},
          Case{R"({"uri": "data:image/png;base64,!!!!"})", "is not valid base64"},
          Case{R"({"uri": "data:image/png,abc"})", "is not valid base64"},
          Case{R"({"uri": "data:image/png;base64,AAAA"})", "it is not a picture"},
          Case{R"({"bufferView": 7})", "buffer view 7 does not exist"},
          Case{R"({"bufferView": 2})", "its bytes are not in the file"},
          Case{R"({})", "it has neither a name nor bytes"}}) {
        std::string text = gltf(fmt::format(R"({}, "images": [{}], "textures": [{{"source": 0}}],
"materials": [{{"name": "m", "pbrMetallicRoughness": {{"baseColorTexture": {{"index": 0}}}}}}])",
                                            k_plain_nodes, wrong.image),
                                R"(, "material": 0)");
        const std::string view = R"({"buffer": 0, "byteOffset": 36, "byteLength": 24})";
        text.replace(text.find(view), view.size(),
                     view + R"(, {"buffer": 0, "byteOffset": 50, "byteLength": 4000000000})");
        folder.write("a.gltf", text);
        const CommandResult result = folder.run("render a.gltf -o a.ppm");
        INFO(wrong.image << '\n' << result.err);
        CHECK(result.exit_code == 0);
        CHECK(holds(result.err, "a texture of material 'm' is left out: "));
        CHECK(holds(result.err, wrong.reason));
    }
}

TEST_CASE("values of the wrong type in a glTF file become defaults, and cyclic nodes are refused") {
    const Folder folder;
    folder.write(
        "a.gltf",
        gltf(R"("nodes": [{"mesh": 0}, {"camera": 0, "name": 7}, {"extensions": {"KHR_lights_punctual": 5}}],
"cameras": [{"type": 3, "perspective": []}], "extensions": {"KHR_lights_punctual": {"lights": {}}},
"textures": 4, "images": "x", "samplers": [[]],
"materials": [{"name": [], "extensions": [], "alphaMode": 1, "emissiveFactor": [1],
  "pbrMetallicRoughness": {"baseColorFactor": ["a", 1, 1, 1], "metallicFactor": "x", "baseColorTexture": {"index": "0"}}}])",
             R"(, "material": 0)"));
    expect(folder.run("render a.gltf -o a.ppm"), 0);
    folder.write("b.gltf", gltf(R"("nodes": [{"mesh": 0, "children": [1]}, {"children": [0]}, {}])"));
    expect(folder.run("render b.gltf -o a.ppm"), 1, {"has two parents or contains itself"});
}

namespace {

/// A triangle with a lamp in front of it, of `intensity` candela or lux.
std::string lit_triangle(const std::string& type, const std::string& intensity) {
    return gltf(fmt::format(R"("nodes": [{{"mesh": 0}}, {{}},
  {{"translation": [0, 0, 3], "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}],
"extensions": {{"KHR_lights_punctual": {{"lights": [{{"name": "lamp", "type": "{}", "intensity": {}}}]}}}})",
                            type, intensity));
}

}  // namespace

TEST_CASE("lights that would burn out the picture, or leave it black, keep their candela and are exposed") {
    const Folder folder;
    for (const char* const intensity : {"1e6", "1e-9"}) {
        folder.write("a.gltf", lit_triangle("point", intensity));
        const CommandResult result =
            expect(folder.run("render a.gltf -o a.ppm"), 0,
                   {"'exposure' in [observer] suits its lights", "default is -0.263"});
        // The key has limits, which lamps of a nanocandela exceed.
        CHECK(holds(result.err, "times as bright as in the file") == (intensity == std::string("1e-9")));
        const Ppm picture = read_ppm(folder / "a.ppm");
        const int middle = picture.at(picture.width / 2, picture.height / 2)[1];
        CHECK(middle > 60);
        CHECK(middle < 255);
    }
}

TEST_CASE(
    "a glTF file's lights are in candela and lux, exposed by 1 as in glTF-Sample-Viewer where they suit "
    "that") {
    const Folder folder;
    folder.write("a.gltf", lit_triangle("directional", "5"));
    const CommandResult plain = succeeded(folder.run("import a.gltf -o -"));
    CHECK(holds(plain.out, "intensity = \"5 lx\"\n"));
    CHECK_FALSE(holds(plain.out + plain.err, "exposure"));
    folder.write("b.gltf", lit_triangle("directional", "50000"));
    const CommandResult bright = succeeded(folder.run("import b.gltf -o -"));
    CHECK(holds(bright.out, "intensity = \"50000 lx\"\n"));
    // A white surface that faces the light sends 50000 / pi cd/m², which is to become 1.6: 1 / (1.2 * 2^EV)
    // is 1.6 pi / 50000.
    CHECK(holds(bright.out,
                fmt::format("exposure     = {:.2f}\n", std::log2(50000 / (1.2 * 1.6 * std::numbers::pi)))));
    // The same picture as of a light that sends 1.6 without an exposure, but for the rounding of the
    // exposure.
    folder.write("c.gltf", lit_triangle("directional", fmt::format("{}", 1.6 * std::numbers::pi)));
    succeeded(folder.run("render b.gltf -o b.ppm"));
    succeeded(folder.run("render c.gltf -o c.ppm"));
    CHECK(largest_difference(read_ppm(folder / "b.ppm"), read_ppm(folder / "c.ppm")) <= 1);
}

TEST_CASE(
    "lamps at the camera, or at the same position, are moved apart with a note, and give a valid scene") {
    const Folder folder;
    const char* const lamp =
        R"({"translation": [0, 0, 3], "extensions": {"KHR_lights_punctual": {"light": 0}}})";
    folder.write("a.gltf",
                 gltf(fmt::format(R"("nodes": [{{"mesh": 0}}, {{"translation": [0, 0, 3], "camera": 0}},
  {{"children": [3, 4, 5]}}, {0}, {0}, {0}],
"cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.8, "znear": 0.1}}}}],
"extensions": {{"KHR_lights_punctual": {{"lights": [{{"type": "point"}}]}}}})",
                                  lamp)));
    const CommandResult result = folder.run("import a.gltf -o a.toml");
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    CHECK(holds(result.err, "lights at the position of another light or the camera are moved"));
    expect(folder.run("check a.toml"), 0);
    std::set<std::string> positions;
    std::istringstream scene(folder.read("a.toml"));
    for (std::string line; std::getline(scene, line);)
        if (line.starts_with("position")) positions.insert(line.substr(line.find('[')));
    CHECK(positions.size() == 4);
}

TEST_CASE("vertex colours are shown unchanged, and z is up in STL files") {
    const Folder folder;
    folder.write(
        "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "property uchar red\nproperty uchar green\nproperty uchar blue\nelement face 1\n"
        "property list uchar int vertex_indices\nend_header\n"
        "-1 -1 0 255 0 0\n1 -1 0 255 0 0\n0 1 0 255 0 0\n3 0 1 2\n");
    const CommandResult ply = folder.run("import a.ply -o -");
    CHECK(holds(ply.out, "color               = [255, 255, 255]\n"));
    folder.write("b.stl",
                 "solid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 "
                 "7\nendloop\nendfacet\n"
                 "endsolid b\n");
    CHECK(holds(folder.run("import b.stl -o -").out, "rotation            = [-90.0, 0.0, 0.0]\n"));
    CHECK_FALSE(holds(folder.run("import b.stl --up y --plain -o -").out, "rotation"));
    expect(folder.run("import b.stl --up x -o -"), 2);
}

TEST_CASE("verbs that take a scene also take a model; edit says what to do instead") {
    const Folder folder;
    folder.write("two.obj", k_squares);
    folder.write("two.mtl", k_two_materials);
    CHECK(holds(folder.run("check two.obj").out, "objects   2"));
    CHECK(
        folder.run("render two.obj -o a.ppm --reflection lambert --width 40 --set object.left.color=[1,2,3]")
            .exit_code == 0);
    expect(folder.run("compare two.obj --shading flat,phong -o a.ppm"), 0);
    expect(folder.run("edit two.obj --change image.width=3"), 2,
           {"'two.obj' is a model, not a scene; make a scene of it with candela import"});
    expect(folder.run("render two.obj scene.toml -o a.ppm"), 2, {"which is shown on its own"});
}

TEST_CASE("import refuses files that are not models, missing or broken, and writes nothing") {
    const Folder folder;
    folder.write("a.txt", "hello");
    folder.write("broken.obj", "v 0 0\nf 1 2 3\n");
    expect(folder.run("import a.txt"), 2,
           {"'a.txt' has an unsupported format; expected .obj, .ply, .stl, .gltf or .glb"});
    expect(folder.run("import b.obj"), 1, {"'b.obj' does not exist"});
    expect(folder.run("import broken.obj"), 1, {"line 1: a vertex has three coordinates"});
    expect(folder.run("import"), 2);
    CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 2);
}

TEST_CASE("a PLY file shows the texture named in MeshLab's comment") {
    const Folder folder;
    const auto write = [&](const char* picture) {
        folder.write(
            "a.ply",
            fmt::format(
                "ply\nformat ascii 1.0\ncomment TextureFile {}\nelement vertex 4\nproperty float x\n"
                "property float y\nproperty float z\nelement face 1\nproperty list uchar int "
                "vertex_indices\nproperty list uchar float texcoord\nend_header\n0 0 0\n1 0 0\n1 1 0\n"
                "0 1 0\n4 0 1 2 3 8 0 0 1 0 1 1 0 1\n",
                picture));
    };
    folder.write("red paint.ppm", std::string("P6\n1 1\n255\n\xff\0\0", 14));
    write("red paint.ppm");
    const CommandResult result = succeeded(folder.run("render a.ply -o a.ppm"));
    CHECK_FALSE(holds(result.err, "warning"));
    const Ppm picture = read_ppm(folder / "a.ppm");
    const auto middle = picture.at(picture.width / 2, picture.height / 2);
    CHECK(middle[0] > 4 * middle[1]);
    write("nowhere.png");
    CHECK(holds(folder.run("render a.ply -o a.ppm").err, "its texture 'nowhere.png' does not exist"));
    write("../a.ppm");
    write_file(folder.path().parent_path() / "a.ppm", grey_ppm(9));
    CHECK(holds(folder.run("render a.ply -o a.ppm").err, "is outside the model's folder"));
}
