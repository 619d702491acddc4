// OBJ and MTL files with the peculiarities of the programs that wrote them, and the pictures they name.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/ppm.h"
#include "support/scene_tables.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// A square that faces +z, with texture coordinates.
std::string square(const std::string& library, const std::string& material) {
    return "mtllib " + library +
           "\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl " + material +
           "\nf 1/1 2/2 3/3 4/4\n";
}

/// A ball of radius `r` at a position.
std::string ball(double r, std::array<double, 3> at, const std::string& begin = "") {
    constexpr int k_rings = 24, k_columns = 48;
    std::string text = begin;
    for (int i = 0; i <= k_rings; ++i)
        for (int k = 0; k <= k_columns; ++k) {
            const double t = std::numbers::pi * i / k_rings,
                         f = 2 * std::numbers::pi * (k % k_columns) / k_columns;
            text += fmt::format("v {:.7f} {:.7f} {:.7f}\n", at[0] + r * std::sin(t) * std::cos(f),
                                at[1] + r * std::cos(t), at[2] - r * std::sin(t) * std::sin(f));
        }
    for (int i = 0; i < k_rings; ++i)
        for (int k = 1; k <= k_columns; ++k) {
            const int a = i * (k_columns + 1) + k, b = a + k_columns + 1;
            text += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
        }
    return text;
}

struct Rendered {
    CommandResult result;
    Ppm image;
};

Rendered rendered(const Folder& folder, const std::string& model, const std::vector<std::string>& more = {}) {
    Rendered result{folder.run("render " + model + " -o " + model + ".ppm", more), {}};
    INFO(result.result.err);
    REQUIRE(result.result.exit_code == 0);
    result.image = read_ppm(folder / (model + ".ppm"));
    return result;
}

bool is_red(std::array<int, 3> pixel) { return pixel[0] > 100 && pixel[1] < 60 && pixel[2] < 60; }

constexpr const char* k_red = "newmtl m\nKd 1 0 0\n";

std::string red_ppm() { return std::string("P6\n1 1\n255\n\xff\0\0", 14); }

}  // namespace

TEST_CASE("a library is found by its name on another system") {
    const Folder folder;
    fs::create_directory(folder / "Materials");
    folder.write("my paints.mtl", k_red);
    write_file(folder / "Materials" / "a.mtl", k_red);
    struct Case {
        const char* name;
        bool is_noted;
    };
    for (const Case& named :
         {Case{".\\my paints.mtl", false}, Case{"C:\\models\\my paints.mtl", false},
          Case{"MY Paints.MTL", true}, Case{"\"my paints.mtl\"", false}, Case{"my paints.mtl\\", false},
          Case{"Materials\\a.mtl", false}, Case{".\\materials\\A.mtl", true},
          Case{"no.mtl Materials/a.mtl", false}, Case{"my paints.mtl \t", false}}) {
        INFO(named.name);
        folder.write("a.obj", square(named.name, "m"));
        const Rendered model = rendered(folder, "a.obj");
        CHECK(is_red(model.image.middle()));
        CHECK(holds(model.result.err, "is read from") == named.is_noted);
    }
    folder.write("a.obj", square("no such.mtl", "m"));
    CHECK(holds(rendered(folder, "a.obj").result.err, "the material library 'no such.mtl' cannot be read"));
}

TEST_CASE("a texture is found despite other capitals, with a note") {
    const Folder folder;
    folder.write("Red.ppm", red_ppm());
    folder.write("a.mtl", "newmtl m\nmap_Kd textures\\RED.PPM\n");
    folder.write("a.obj", square("a.mtl", "m"));
    const Rendered model = rendered(folder, "a.obj");
    CHECK(is_red(model.image.middle()));
    CHECK(holds(model.result.err, "the texture 'textures\\RED.PPM' of material 'm' is read from 'Red.ppm'"));
}

TEST_CASE("names in 8-bit encodings are found as bytes and as decoded text") {
    const Folder folder;
    // Latin-1 in the files, UTF-8 on the disk.
    write_file(folder /
                   "gr\xc3\xbc\xc3\x9f"
                   "e.mtl",
               "newmtl t\xfcr\nmap_Kd h\xf6lzern.ppm\n");
    folder.write("h\xc3\xb6lzern.ppm", red_ppm());
    folder.write("a.obj", square("gr\xfc\xdf"
                                 "e.mtl",
                                 "t\xfcr"));
    CHECK(is_red(rendered(folder, "a.obj").image.middle()));
    // Shift-JIS, whose second bytes may be a backslash.
    folder.write("\xe8\xa1\xa8.ppm", red_ppm());
    folder.write("b.mtl", "newmtl m\nmap_Kd \x95\\.ppm\n");
    folder.write("b.obj", square("b.mtl", "m"));
    CHECK(is_red(rendered(folder, "b.obj").image.middle()));
    // The same bytes on the disk, which a scene cannot name: the picture is written next to it.
    fs::remove(folder / "h\xc3\xb6lzern.ppm");
    folder.write("h\xf6lzern.ppm", red_ppm());
    CHECK(is_red(rendered(folder, "a.obj").image.middle()));
    succeeded(folder.run("import a.obj -o c.toml"));
    CHECK(is_red(rendered(folder, "c.toml").image.middle()));
}

TEST_CASE("materials whose names contain '#', tabs, blanks or a final backslash are distinguished") {
    const Folder folder;
    folder.write("a.mtl",
                 "newmtl Paint #1 \nKd 1 0 0\nnewmtl Paint\t#2\nKd 0 1 0\nnewmtl wood\\\nKd 0 0 1\n"
                 "newmtl door # of oak\nKd 0 0 0.5\n");
    folder.write(
        "a.obj",
        "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl Paint #1\nf 1 2 3\nusemtl Paint #2\t\nf 1 2 3\n"
        "usemtl wood\\\nf 1 2 3\nusemtl door\nf 1 2 3\n");
    const CommandResult result = succeeded(folder.run("import a.obj -o a.toml"));
    CHECK_FALSE(holds(result.err, "warning"));
    const std::string scene = folder.read("a.toml");
    for (const char* const part :
         {"part                = \"Paint #1\"\n", "part                = \"Paint #2\"\n",
          "part                = \"wood\\\\\"\n", "part                = \"door\"\n",
          "kd        = [1.0, 0.0, 0.0]\n", "kd        = [0.0, 1.0, 0.0]\n", "kd        = [0.0, 0.0, 1.0]\n",
          "kd        = [0.0, 0.0, 0.5]\n"})
        CHECK(holds(scene, part));
    expect(folder.run("check a.toml"), 0);
}

TEST_CASE("byte order marks of a model and its library are skipped") {
    const Folder folder;
    folder.write("a.mtl", std::string("\xef\xbb\xbf") + k_red);
    folder.write("a.obj", "\xef\xbb\xbf" + square("a.mtl", "m"));
    CHECK(is_red(rendered(folder, "a.obj").image.middle()));
    folder.write("a.mtl", std::string("\xff\xfen\0e\0w\0", 8));
    CHECK(holds(rendered(folder, "a.obj").result.err, "is left out: it is UTF-16"));
}

TEST_CASE("a library that no face uses is noted") {
    const Folder folder;
    folder.write("a.mtl", k_red);
    folder.write("a.obj", "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    CHECK(holds(rendered(folder, "a.obj").result.err, "no face uses a material (usemtl)"));
}

TEST_CASE("an ambient colour of white, or none, becomes the surface's own: unlit sides keep its hue") {
    const Folder folder;
    for (const char* const ambient : {"Ka 1 1 1\n", "Ka 1.000000 1.000000 1.000000\nillum 1\n", ""}) {
        INFO(ambient);
        folder.write("a.mtl", fmt::format("newmtl m\nKd 0.8 0 0\n{}", ambient));
        folder.write("a.obj", ball(1, {}, "mtllib a.mtl\nusemtl m\n"));
        const Rendered model = rendered(folder, "a.obj");
        int bleached = 0;
        for (int y = 0; y < model.image.height; ++y)
            for (int x = 0; x < model.image.width; ++x) {
                const auto pixel = model.image.at(x, y);
                bleached += pixel[1] > 70;  // the background's red is 43
            }
        CHECK(bleached == 0);
    }
    folder.write("a.mtl", "newmtl m\nKd 0.8 0.4 0\nKa 0.1 0.2 0.3\n");
    CHECK(holds(folder.run("import a.obj -o -").out, "ka        = [0.1, 0.2, 0.3]\n"));
}

TEST_CASE("a material that says how rough or metallic it is becomes metallic-roughness") {
    const Folder folder;
    // 0.2158605 is 128 in sRGB.
    folder.write(
        "a.mtl",
        "newmtl m\nKd 1 0.2158605 0\nKs 0.5 0.5 0.5\nNs 100\nPr 0.25\nPm 1.000000\nPs 0.125\nPc 0.5\n"
        "Pcr 0.1\naniso 0.75\nanisor 0.25\n");
    folder.write("a.obj", square("a.mtl", "m"));
    const CommandResult imported = succeeded(folder.run("import a.obj -o -"));
    INFO(imported.out);
    CHECK(holds(imported.out, "color               = [255, 128, 0]\n"));
    CHECK(holds(imported.out,
                "metallic            = 1.0\nroughness           = 0.25\nclearcoat           = 0.5\n"
                "clearcoat_roughness = 0.1\nsheen_color         = 0.125\n"));
    CHECK(holds(imported.out, "anisotropy_strength = 0.75\nanisotropy_rotation = 90.0\n"));
    CHECK_FALSE(holds(imported.err, "roughness"));
    rendered(folder, "a.obj");
}

TEST_CASE("pictures of roughness and metalness in MTL files become textures of the parameters") {
    const Folder folder;
    folder.write("p.ppm", "P6\n2 1\n255\n\x33\x66\x99\xcc\xcc\xcc");
    folder.write("a.mtl",
                 "newmtl m\nKd 1 1 1\nPr 0.5\nPm 0\nmap_Pr p.ppm\nmap_Pm -clamp on -imfchan g p.ppm\n");
    folder.write("a.obj", square("a.mtl", "m"));
    const CommandResult imported = succeeded(folder.run("import a.obj -o -"));
    INFO(imported.out << imported.err);
    CHECK(holds(imported.out,
                "ka        = { texture = \"p.ppm\", channel = \"g\", scale = -0.46, offset = 0.96, wrap = "
                "\"clamp\" }\n"
                "metallic  = { texture = \"p.ppm\", channel = \"g\", wrap = \"clamp\" }\n"
                "roughness = { texture = \"p.ppm\", channel = \"r\", scale = 0.5 }\n"));
    CHECK_FALSE(holds(imported.out, "# Note"));
    rendered(folder, "a.obj");
    folder.write("a.mtl", "newmtl m\nPr 0.5\nmap_Pr no.ppm\n");
    const CommandResult broken = succeeded(folder.run("import a.obj -o -"));
    CHECK(holds(broken.out, "roughness = 0.5\n"));
    CHECK(holds(broken.err, "the texture 'no.ppm' of material 'm' does not exist"));
}

TEST_CASE(
    "maps of MTL files are where -s, which scales coordinates, and -o, which then moves them, put them") {
    const Folder folder;
    // Four columns. Of u = 0.25 u + 0.5, the square shows the third alone.
    folder.write("p.ppm", "P6\n4 1\n255\n" + std::string(6, '\0') + "\xff" + std::string(5, '\0'));
    folder.write(
        "a.mtl",
        "newmtl m\nKd 1 1 1\nmap_Kd -clamp on -s .25 1 1 -o .5 p.ppm\nKe 1 1 1\nmap_Ke -o 0 -2 p.ppm\n");
    folder.write("a.obj", square("a.mtl", "m"));
    const CommandResult imported = succeeded(folder.run("import a.obj -o -"));
    CHECK(holds(
        imported.out,
        "color               = { texture = \"p.ppm\", wrap = \"clamp\", transform = { scale = [0.25, 1.0], "
        "rotation = 0.0, offset = [0.5, 0.0] } }\n"));
    CHECK(holds(imported.out,
                "emission  = { texture = \"p.ppm\", transform = { scale = [1.0, 1.0], rotation = 0.0, "
                "offset = [0.0, -2.0] } }\n"));
    CHECK_FALSE(holds(imported.out, "# Note"));
    CHECK(is_red(rendered(folder, "a.obj").image.middle()));
}

TEST_CASE("norm is a normal map, and so is a bump map of normals") {
    const Folder folder;
    folder.write("n.ppm", "P6\n2 1\n255\n\x70\x80\xf0\x90\x80\xf0");
    folder.write("a.obj", square("a.mtl", "m"));
    const auto imported = [&](const char* statement) {
        folder.write("a.mtl", std::string("newmtl m\nKd 1 1 1\n") + statement + "\n");
        return succeeded(folder.run("import a.obj -o -"));
    };
    CHECK(holds(imported("norm -clamp on n.ppm").out,
                "normal_map          = { texture = \"n.ppm\", wrap = \"clamp\" }\n"));
    CHECK(holds(imported("map_Bump -bm 0.5 n.ppm").out,
                "normal_map          = { texture = \"n.ppm\", scale = 0.5 }\n"));
    imported("norm n.ppm");
    CHECK_FALSE(holds(rendered(folder, "a.obj").result.err, "warning"));
}

TEST_CASE("a bump map's white is a hundredth of the side of its picture on the surface above black") {
    const Folder folder;
    folder.write("h.ppm", "P6\n2 1\n255\n\x80\x80\x80\x90\x90\x90");
    // A wall of 3 by 12 metres, and in another material one that is ten times as large.
    const auto imported = [&](const std::string& statement, double across, double up) {
        const auto wall = [&](double scale) {
            return fmt::format("v 0 0 0\nv {0} 0 0\nv {0} {1} 0\nv 0 {1} 0\n", 3 * scale, 12 * scale);
        };
        const std::string uv = fmt::format("vt 0 0\nvt {0} 0\nvt {0} {1}\nvt 0 {1}\n", across, up);
        folder.write("a.obj", "mtllib a.mtl\n" + wall(1) + wall(10) + uv +
                                  "usemtl m\nf 1/1 2/2 3/3 4/4\nusemtl n\nf 5/1 6/2 7/3 8/4\n");
        folder.write("a.mtl", fmt::format("newmtl m\n{0}\nnewmtl n\n{0}\n", statement));
        const CommandResult result = succeeded(folder.run("import a.obj -o -"));
        CHECK_FALSE(holds(result.err, "bump"));
        return result.out;
    };
    // Once over the wall: 6 metres are the side of a square of the same area.
    const std::string once = imported("bump h.ppm", 1, 1);
    CHECK(holds(once, "bump_map            = { texture = \"h.ppm\", height = 0.06 }\n"));
    CHECK(holds(once, "bump_map            = { texture = \"h.ppm\", height = 0.6 }\n"));
    // Eight times over it, mirrored, and lower.
    const std::string often = imported("map_Bump -bm -0.5 -clamp on h.ppm", -2, 4);
    CHECK(holds(often, fmt::format("height = {:.4g}, wrap = \"clamp\" }}\n", -0.03 / std::sqrt(8))));
    CHECK(holds(often, fmt::format("height = {:.4g}, wrap = \"clamp\" }}\n", -0.3 / std::sqrt(8))));
    // Onto a line of the picture.
    CHECK_FALSE(holds(imported("bump h.ppm", 1, 0), "bump_map"));
    CHECK_FALSE(holds(imported("bump -bm 0 h.ppm", 1, 1), "bump_map"));
    imported("bump h.ppm", 1, 1);
    CHECK_FALSE(holds(rendered(folder, "a.obj").result.err, "warning"));
}

TEST_CASE("a texture's factor of zero becomes one") {
    const Folder folder;
    folder.write("red.ppm", red_ppm());
    folder.write("a.mtl", "newmtl m\nillum 4\nKd 0.00 0.00 0.00\nKa 0 0 0\nTf 1 1 1\nmap_Kd red.ppm\n");
    folder.write("a.obj", square("a.mtl", "m"));
    const Rendered model = rendered(folder, "a.obj");
    CHECK(is_red(model.image.middle()));
    CHECK_FALSE(holds(model.result.err, "transmission"));
}

TEST_CASE("imported materials reflect no more than they receive, with one note, and are not burnt out") {
    const Folder folder;
    for (const char* const material :
         {"Ka 1 1 1\nKd .8 .8 .8\nKs .5 .5 .5\nNs 225\nillum 2\n",
          "Ka 0 0 0\nKd .8 .8 .8\nKs .8 .8 .8\nNs 0\n", "Ka 1 1 1\nKd 1 1 1\nKs 1 1 1\nNs 10\n", "Kd 1 1 1\n",
          "Ka 1 1 1\nKd 0.9 0.2 0.1\nKs 0.3 0.9 0.1\nNs 5\n"}) {
        INFO(material);
        folder.write("a.mtl", fmt::format("newmtl m\n{0}newmtl n\n{0}", material));
        folder.write("a.obj", ball(1, {}, "mtllib a.mtl\nusemtl m\n") + "usemtl n\nf 1 2 3\n");
        const Rendered model = rendered(folder, "a.obj");
        CHECK(model.image.burnt() < 0.05);
        CHECK_FALSE(holds(model.result.err, "more light than it receives"));
        const std::string note = "materials that reflect more light than they receive";
        CHECK(model.result.err.find(note) == model.result.err.rfind(note));
    }
    folder.write("a.mtl", "newmtl m\nKd .8 .8 .8\nKs .5 .5 .5\nNs 225\n");
    CHECK(holds(rendered(folder, "a.obj").result.err, "materials that reflect more light than they receive"));
    folder.write("a.mtl", "newmtl m\nKd .5 .5 .5\nKs .5 .5 .5\n");
    const CommandResult without = folder.run("import a.obj -o -");
    CHECK(holds(without.err, "highlights without an exponent (Ns)"));
    CHECK(holds(without.out, "ks        = 0.0\n"));
}

TEST_CASE("a picture's format follows from its content: a misnamed one is read, with a note") {
    const Folder folder;
    folder.write("flat.toml", k_start + image_table(8, 8) + "background = [230, 10, 20]\n" + k_models);
    for (const char* const name : {"red.jpg", "red.png"})
        succeeded(folder.run_words({"render", "flat.toml", "-o", name}));
    fs::rename(folder / "red.jpg", folder / "wrong.png");
    fs::rename(folder / "red.png", folder / "wrong.jpg");
    folder.write("a.obj", square("a.mtl", "m"));
    for (const char* const name : {"wrong.png", "wrong.jpg"}) {
        INFO(name);
        folder.write("a.mtl", fmt::format("newmtl m\nmap_Kd {}\n", name));
        const Rendered model = rendered(folder, "a.obj");
        CHECK(is_red(model.image.middle()));
        CHECK(holds(model.result.err, fmt::format("is read as {}, according to its content",
                                                  name == std::string("wrong.png") ? "jpg" : "png")));
        succeeded(folder.run("import a.obj -o a.toml --force"));
        const Rendered scene = rendered(folder, "a.toml");
        CHECK(is_red(scene.image.middle()));
        CHECK_FALSE(holds(scene.result.err, "warning"));
    }
}

TEST_CASE("a broken or empty picture becomes a note and a plain colour on import, and an error in a scene") {
    const Folder folder;
    folder.write("a.obj", square("a.mtl", "m"));
    folder.write("cut.ppm", "P6\n100 100\n255\nabc");
    folder.write("empty.png", "");
    folder.write("text.png", "this is not a picture");
    folder.write("cut.jpg", "\xff\xd8\xff\xe0");
    for (const char* const name : {"cut.ppm", "empty.png", "text.png", "cut.jpg"}) {
        INFO(name);
        folder.write("a.mtl", fmt::format("newmtl m\nKd 1 0 0\nmap_Kd {}\n", name));
        const Rendered model = rendered(folder, "a.obj");
        CHECK(is_red(model.image.middle()));
        CHECK(holds(model.result.err, fmt::format("the texture '{}' of material 'm' is left out: ", name)));
        folder.write("a.toml",
                     k_start + k_models +
                         fmt::format("[[object]]\ntype = \"mesh\"\nfile = \"a.obj\"\nencloses = true\n"
                                     "color = {{ texture = \"{}\" }}\n",
                                     name));
        const CommandResult scene = folder.run("render a.toml -o b.ppm");
        CHECK(scene.exit_code != 0);
        CHECK(holds(scene.err, "cannot be read as a picture"));
    }
}

TEST_CASE("with --allow-outside a model may name files outside its folder; messages name the option") {
    const Folder folder;
    for (const char* const each : {"models", "textures"}) fs::create_directory(folder / each);
    write_file(folder / "textures" / "red.ppm", red_ppm());
    write_file(folder / "textures" / "a.mtl", "newmtl m\nmap_Kd red.ppm\n");
    write_file(folder / "models" / "a.obj", square("../textures/a.mtl", "m"));
    const Rendered refused = rendered(folder, "models/a.obj");
    CHECK_FALSE(is_red(refused.image.middle()));
    CHECK(holds(refused.result.err, "is outside the model's folder; --allow-outside reads it"));
    CHECK(is_red(rendered(folder, "models/a.obj", {"--allow-outside"}).image.middle()));
    succeeded(folder.run("import models/a.obj --allow-outside -o scene.toml"));
    CHECK(is_red(rendered(folder, "scene.toml").image.middle()));
    expect(folder.run("check models/a.obj --allow-outside"), 0);

    expect(folder.run("check scene.toml --allow-outside"), 2, {"give the object allow_outside = true"});

    folder.write("b.bin", std::string(36, '\0'));
    write_file(folder / "models" / "b.gltf",
               R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "../b.bin"}]})");
    expect(folder.run("render models/b.gltf -o b.ppm"), 1, {"--allow-outside"});
    expect(folder.run("render models/b.gltf --allow-outside -o b.ppm"), 0);
}

TEST_CASE("a model far from its origin gives the same picture as at the origin") {
    const Folder folder({{"here.obj", ball(1, {0, 0, 0})}});
    const Ppm here = rendered(folder, "here.obj").image;
    for (const std::array<double, 3>& at : {std::array{500000.25, 4500000.75, 120.0},
                                            {4500000.0, 600000.0, 4400000.0},
                                            {0.0, -1000000.0, 0.0},
                                            {3e8, 0, 0},
                                            {150.0, 0, 0}}) {
        INFO(at[0]);
        folder.write("far.obj", ball(1, at));
        const Rendered far = rendered(folder, "far.obj");
        CHECK(holds(far.result.err, "which is the scene's origin") == (at[0] != 150));
        const int most = largest_difference(far.image, here);
        CHECK(most <= 2);
    }
}

TEST_CASE("a small model far from the origin is drawn, and its scene says where it lies") {
    const Folder folder({{"a.obj", ball(0.05, {500000.25, 4500000.75, 120})}});
    const Rendered model = rendered(folder, "a.obj");
    CHECK(model.image.middle() != model.image.at(0, 0));
    succeeded(folder.run("import a.obj -o a.toml"));
    CHECK(holds(folder.read("a.toml"), "origin              = \"500000.25 4500000.75 120\"\n"));
    CHECK(rendered(folder, "a.toml").image.bytes == model.image.bytes);
    // Also beyond a scene's largest coordinates, and with z up.
    folder.write("b.obj", ball(20000, {6.4e9, 0, -6.4e9}));
    CHECK(rendered(folder, "b.obj").image.middle() != model.image.at(0, 0));
    succeeded(folder.run("import a.obj --up z -o z.toml"));
    CHECK(holds(folder.read("z.toml"), "origin              = \"500000.25 4500000.75 120\"\n"));
    CHECK(rendered(folder, "z.toml").image.middle() != model.image.at(0, 0));
}

TEST_CASE("numbers of a scene are read back unchanged even if six digits are too few") {
    const Folder folder({{"a.obj", ball(1, {99.015625, 0, 0})}});
    const CommandResult result = folder.run("import a.obj -o -");
    CHECK_FALSE(holds(result.out, "origin"));
    CHECK(holds(result.out, "= [99.015625, "));
}

TEST_CASE("the camera and lights of a glTF file far from the origin are moved with it") {
    const Folder folder;
    const auto scene_at = [&](const char* name, double x, double y, double z) {
        folder.write(name,
                     fmt::format(R"({{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": [0]}}],
"nodes": [{{"translation": [{}, {}, {}], "children": [1, 2, 3]}}, {{"mesh": 0}}, {{"camera": 0, "translation": [0.25, 0.25, 3]}},
  {{"translation": [0.5, 1, 2], "extensions": {{"KHR_lights_punctual": {{"light": 0}}}}}}],
"cameras": [{{"type": "perspective", "perspective": {{"yfov": 0.5, "znear": 0.1}}}}],
"extensions": {{"KHR_lights_punctual": {{"lights": [{{"type": "point", "intensity": 20}}]}}}},
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}}]}})",
                                 x, y, z));
        return rendered(folder, name).image;
    };
    const Ppm here = scene_at("here.gltf", 0, 0, 0), far = scene_at("far.gltf", 500000.25, 4500000.75, 120);
    CHECK(here.middle() != here.at(0, 0));
    const int most = largest_difference(far, here);
    CHECK(most <= 2);
}

TEST_CASE("losses of one kind become one note with a count") {
    const Folder folder;
    std::string model = "mtllib a.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\n", library;
    for (int i = 0; i < 50; ++i) {
        model += fmt::format("usemtl m{0}\nf 1/1 2/1 3/1\nusemtl n{0}\nf 1/1 2/1 3/1\n", i);
        library += fmt::format("newmtl m{0}\nmap_Kd no{0}.png\n", i);
    }
    folder.write("a.obj", model);
    folder.write("a.mtl", library);
    const CommandResult result =
        expect(folder.run("import a.obj -o -"), 0,
               {"50 textures do not exist, the first of them 'no0.png' of material 'm0'",
                "50 materials are not in any material library, the first of them 'n0'"});
    CHECK(std::ranges::count(result.err, '\n') == 2);
}
