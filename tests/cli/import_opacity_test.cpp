// candela import: how much materials of glTF and MTL files cover.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_square.h"
#include "support/text.h"

namespace {

/// Four texels whose opacities differ.
std::string picture() {
    return png(2, 2, {{51, 102, 255, 255}, {10, 20, 30, 0}, {255, 0, 0, 100}, {128, 128, 128, 200}});
}

std::string imported(const Folder& folder, const std::string& file) {
    const CommandResult result = succeeded(folder.run("import " + file + " --force -o scene.toml"));
    INFO(result.err);
    CHECK_FALSE(holds(result.err, "opacity"));
    succeeded(folder.run("check scene.toml"));
    return folder.read("scene.toml");
}

const char* const k_mesh =
    "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\n"
    "f 1/1 2/2 3/3 4/4\n";

}  // namespace

TEST_CASE("a glTF file's opacity comes back as it went in") {
    const Folder folder;
    for (const bool is_mask : {true, false}) {
        GltfSquare file;
        file.pbr() = {{"metallicFactor", 0},
                      {"baseColorFactor", {1, 1, 1, 0.75}},
                      {"baseColorTexture", file.texture(picture())}};
        file.material()["alphaMode"] = is_mask ? "MASK" : "BLEND";
        if (is_mask) file.material()["alphaCutoff"] = 0.25;
        folder.write("a.glb", file.glb());
        const std::string scene = imported(folder, "a.glb"), opacity = "channel = \"a\", scale = 0.75 }\n";
        CHECK(holds(scene, opacity));
        CHECK(holds(scene, "opacity_cutoff = 0.25\n") == is_mask);
        succeeded(folder.run("generate scene.toml --target gltf -o made --approximate --quiet"));
        const std::string made = folder.read("made/scene.glb");
        CHECK(holds(made, is_mask ? R"("alphaMode":"MASK")" : R"("alphaMode":"BLEND")"));
        CHECK(holds(made, R"("baseColorFactor":[1.0,1.0,1.0,0.75])"));
        // The picture is there once, with its colours and its alpha.
        CHECK(holds(made, picture()));
        CHECK(made.find("\x89PNG") == made.rfind("\x89PNG"));
        const std::string again = imported(folder, "made/scene.glb");
        CHECK(holds(again, opacity));
        CHECK(holds(again, "opacity_cutoff = 0.25\n") == is_mask);
    }
}

TEST_CASE("the alpha of a glTF file's vertices is opacity where its material blends or cuts") {
    const Folder folder;
    GltfSquare file;
    file.primitive()["attributes"]["COLOR_0"] =
        file.floats("VEC4", {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0});
    file.pbr() = {{"metallicFactor", 0}, {"baseColorFactor", {1, 1, 1, 0.75}}};
    const auto scene = [&] {
        folder.write("a.glb", file.glb());
        return imported(folder, "a.glb");
    };
    CHECK_FALSE(holds(scene(), "opacity"));
    file.material()["alphaMode"] = "BLEND";
    CHECK(holds(scene(), "{ attribute = \"color\", channel = \"a\", scale = 0.75 }\n"));
    file.material()["alphaMode"] = "MASK";
    const std::string mask = scene();
    CHECK(holds(mask, "{ attribute = \"color\", channel = \"a\", scale = 0.75 }\n"));
    CHECK(holds(mask, "opacity_cutoff = 0.5\n"));
}

TEST_CASE("the alpha of a glTF file's vertices multiplies that of its picture and of its colour") {
    const Folder folder;
    GltfSquare file;
    file.primitive()["attributes"]["COLOR_0"] =
        file.floats("VEC4", {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0});
    file.pbr() = {{"metallicFactor", 0},
                  {"baseColorFactor", {1, 1, 1, 0.75}},
                  {"baseColorTexture", file.texture(picture())}};
    file.material()["alphaMode"] = "MASK";
    const std::string vertices = "{ attribute = \"color\", channel = \"a\", scale = 0.75 }";
    folder.write("a.glb", file.glb());
    const std::string scene = imported(folder, "a.glb");
    CHECK(holds(scene, ", channel = \"a\" }, " + vertices + "]\nopacity_cutoff = 0.5\n"));
    SECTION("a picture of one alpha is a number") {
        GltfSquare even = file;
        even.pbr()["baseColorTexture"] = even.texture(png(2, 1, {{51, 102, 255, 51}, {10, 20, 30, 51}}));
        folder.write("b.glb", even.glb());
        CHECK(
            holds(imported(folder, "b.glb"), "= { attribute = \"color\", channel = \"a\", scale = 0.15 }\n"));
    }
    SECTION("without texture coordinates, the vertices' alone is left") {
        file.primitive()["attributes"].erase("TEXCOORD_0");
        folder.write("c.glb", file.glb());
        CHECK(holds(imported(folder, "c.glb"), "= " + vertices + "\n"));
    }
}

TEST_CASE("d, Tr and map_d of MTL files are opacity") {
    const Folder folder;
    folder.write("a.obj", k_mesh);
    folder.write("grey.ppm", "P6\n2 1\n255\n\x33\x33\x33\xcc\xcc\xcc");
    folder.write("leaf.png", picture());
    const auto scene_of = [&](const std::string& lines) {
        folder.write("a.mtl", "newmtl m\nKd 1 1 1\n" + lines);
        return imported(folder, "a.obj");
    };
    CHECK(holds(scene_of("d 0.25\n"), "opacity   = 0.25\n"));
    CHECK(holds(scene_of("Tr 0.25\n"), "opacity   = 0.75\n"));
    CHECK(holds(scene_of("Pr 0.5\nd 0.25\n"), "opacity   = 0.25\n"));
    CHECK_FALSE(holds(scene_of("d 1\nTr 0\n"), "opacity"));
    CHECK(holds(scene_of("map_d grey.ppm\n"), "opacity   = { texture = \"grey.ppm\", channel = \"r\" }\n"));
    CHECK(holds(scene_of("d 0.5\nmap_d -clamp on leaf.png\n"),
                "opacity   = { texture = \"leaf.png\", channel = \"a\", scale = 0.5, wrap = \"clamp\" }\n"));
    // Some programs write 0 next to a picture, and mean the picture.
    CHECK(holds(scene_of("d 0\nmap_d leaf.png\n"), "{ texture = \"leaf.png\", channel = \"a\" }\n"));
    CHECK(holds(scene_of("d 0.5\nmap_d no.png\n"), "opacity   = 0.5\n"));
}
