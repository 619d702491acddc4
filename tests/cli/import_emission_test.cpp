// candela import: what materials of glTF and MTL files emit, and their occlusion.
#include <catch2/catch_test_macros.hpp>
#include <string>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_square.h"
#include "support/text.h"

namespace {

/// Four texels, all different.
std::string picture() {
    return png(2, 2, {{51, 102, 255, 255}, {10, 20, 30, 255}, {255, 0, 0, 255}, {128, 128, 128, 255}});
}

/// The scene of an imported file; `err` of a run that must succeed.
std::string imported(const Folder& folder, const std::string& file, const std::string& absent = "emit") {
    const CommandResult result = succeeded(folder.run("import " + file + " --force -o scene.toml"));
    INFO(result.err);
    CHECK_FALSE(holds(result.err, absent));
    succeeded(folder.run("check scene.toml"));
    return folder.read("scene.toml");
}

std::string imported(GltfSquare& file, const Folder& folder) {
    folder.write("a.glb", file.glb());
    return imported(folder, "a.glb");
}

const char* const k_mesh =
    "mtllib a.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nusemtl m\n"
    "f 1/1 2/2 3/3 4/4\n";

}  // namespace

TEST_CASE("a glTF file's emission is a colour and its strength") {
    const Folder folder;
    GltfSquare file;
    // 0.2158605 is 128 in sRGB.
    file.material()["emissiveFactor"] = {1, 0.2158605, 0};
    CHECK(holds(imported(file, folder), "emission  = [255, 128, 0]\n"));
    file.material()["emissiveFactor"] = {0.5, 0.10793025, 0};
    file.material()["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 12;
    const std::string strong = imported(file, folder);
    CHECK(holds(strong, "emission          = [255, 128, 0]\nemission_strength = 6.0\n"));
    file.material()["emissiveFactor"] = {0, 0, 0};
    CHECK_FALSE(holds(imported(file, folder), "emission"));
}

TEST_CASE("a glTF file's maps of emission and occlusion are textures, and are written back") {
    const Folder folder;
    GltfSquare file;
    file.material()["emissiveFactor"] = {1, 0.5, 0.25};
    file.material()["emissiveTexture"] = file.texture(picture());
    file.material()["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = 3;
    file.material()["occlusionTexture"] = file.texture(picture());
    file.material()["occlusionTexture"]["strength"] = 0.75;
    const std::string scene = imported(file, folder);
    CHECK(holds(scene, "\", scale = [1.0, 0.5, 0.25] }\nemission_strength = 3.0\n"));
    CHECK(holds(scene, "channel = \"r\", scale = 0.75, offset = 0.25 }\n"));
    succeeded(folder.run("generate scene.toml --target gltf -o made --approximate --quiet"));
    const std::string made = folder.read("made/scene.glb");
    CHECK(holds(made, R"("emissiveFactor":[1.0,0.5,0.25])"));
    CHECK(holds(made, R"("emissiveStrength":3.0)"));
    CHECK(holds(made, R"("strength":0.75)"));
    // The same file again gives the same scene, but for the pictures' names.
    const std::string again = imported(folder, "made/scene.glb");
    CHECK(holds(again, "\", scale = [1.0, 0.5, 0.25] }\nemission_strength = 3.0\n"));
    CHECK(holds(again, "channel = \"r\", scale = 0.75, offset = 0.25 }\n"));
}

TEST_CASE("Ke and map_Ke of MTL files are emission") {
    const Folder folder;
    folder.write("a.obj", k_mesh);
    folder.write("p.ppm", "P6\n2 1\n255\n\x33\x66\x99\xcc\xcc\xcc");
    folder.write("a.mtl", "newmtl m\nKd 1 1 1\nKe 4 0.863442 0\n");
    CHECK(holds(imported(folder, "a.obj"), "emission          = [255, 128, 0]\nemission_strength = 4.0\n"));
    folder.write("a.mtl", "newmtl m\nKd 1 1 1\nPr 0.5\nKe 0 0 0\nmap_Ke -clamp on p.ppm\n");
    CHECK(holds(imported(folder, "a.obj"), "emission  = { texture = \"p.ppm\", wrap = \"clamp\" }\n"));
    folder.write("a.mtl", "newmtl m\nKd 1 1 1\nKe 2 1 0\nmap_Ke p.ppm\n");
    CHECK(holds(imported(folder, "a.obj"),
                "emission          = { texture = \"p.ppm\", scale = [1.0, 0.5, 0.0] }\n"
                "emission_strength = 2.0\n"));
    folder.write("a.mtl", "newmtl m\nKd 1 1 1\nKe 0 0 0\n");
    CHECK_FALSE(holds(imported(folder, "a.obj"), "emission"));
    SECTION("and a picture that is missing leaves the factor") {
        folder.write("a.mtl", "newmtl m\nKd 1 1 1\nKe 1 1 1\nmap_Ke no.ppm\n");
        CHECK(holds(imported(folder, "a.obj"), "emission  = [255, 255, 255]\n"));
    }
}
