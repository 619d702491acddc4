// candela import: the materials of glTF files, and faulty files.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_square.h"
#include "support/text.h"

namespace {

using Json = nlohmann::json;
using Pixel = RgbaPixel;

struct Imported {
    CommandResult result;
    std::string scene;
    std::string image;  // 80 x 60 pixels of three bytes

    Pixel at(int x, int y) const {
        const auto i = 3 * static_cast<std::size_t>(80 * y + x);
        return {static_cast<std::uint8_t>(image[i]), static_cast<std::uint8_t>(image[i + 1]),
                static_cast<std::uint8_t>(image[i + 2]), 255};
    }
    Pixel middle() const { return at(40, 30); }
};

using File = GltfSquare;

/// In light whose pictures are easily compared, unless told otherwise.
Imported import(File file, const std::string& option = " --plain") {
    const Folder folder({{"a.glb", file.glb()}});
    Imported imported{folder.run("import a.glb" + option), "", ""};
    INFO(imported.result.err);
    REQUIRE(imported.result.exit_code == 0);
    imported.scene = folder.read("a.toml");
    const CommandResult rendered = expect(folder.run("render a.toml -o a.ppm --width 80 --height 60"), 0);
    CHECK_FALSE(holds(rendered.err, "warning"));
    const std::string ppm = folder.read("a.ppm");
    imported.image = ppm.substr(ppm.size() - std::size_t{3} * 80 * 60);
    return imported;
}

/// The last `[object.material]` of a scene.
std::string material_in(const std::string& scene) { return scene.substr(scene.rfind("[object.material]")); }

std::string plain_png(Pixel pixel) { return png(1, 1, {pixel}); }

}  // namespace

TEST_CASE("import keeps the numbers of a metallic-roughness material and of its extensions") {
    File plain;
    plain.pbr() = {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"roughnessFactor", 0.3}};
    const std::string scene = import(plain).scene;
    CHECK(holds(scene, "color               = [255, 188, 137]\n"));
    CHECK(material_in(scene) == "[object.material]\nka        = 0.5\nmetallic  = 1.0\nroughness = 0.3\n");

    File file;
    file.pbr() = {{"metallicFactor", 0.25}};
    file.material()["extensions"] = {
        {"KHR_materials_ior", {{"ior", 2}}},
        {"KHR_materials_specular", {{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}}},
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 0.75}, {"clearcoatRoughnessFactor", 0.125}}},
        {"KHR_materials_sheen", {{"sheenColorFactor", {0.5, 0.5, 0.5}}, {"sheenRoughnessFactor", 0.4}}},
        {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.6}, {"anisotropyRotation", 7.8539816}}},
        {"KHR_materials_iridescence",
         {{"iridescenceFactor", 1},
          {"iridescenceIor", 1.5},
          {"iridescenceThicknessMaximum", 500},
          {"iridescenceTexture", file.texture(plain_png({255, 255, 255, 255}))}}}};
    const Imported imported = import(file);
    const std::string material = material_in(imported.scene);
    for (const char* const line :
         {"ka                    = 0.7917\n", "metallic              = 0.25\n",
          "roughness             = 1.0\n", "ior                   = 2.0\n", "specular              = 0.5\n",
          "specular_color        = [1.0, 2.0, 0.5]\n", "clearcoat             = 0.75\n",
          "clearcoat_roughness   = 0.125\n", "sheen_color           = 0.5\n", "sheen_roughness       = 0.4\n",
          "anisotropy_strength   = 0.6\n", "anisotropy_rotation   = 90.0\n", "iridescence           = 1.0\n",
          "iridescence_ior       = 1.5\n", "iridescence_thickness = 500.0\n"}) {
        INFO(line << "in\n" << material);
        CHECK(holds(material, line));
    }
    CHECK_FALSE(holds(imported.scene, "# Note"));
}

TEST_CASE("import limits the numbers of materials to what the model allows") {
    File file;
    file.pbr() = {{"metallicFactor", 7}, {"roughnessFactor", -1}};
    file.material()["extensions"] = {
        {"KHR_materials_ior", {{"ior", 0.5}}},
        {"KHR_materials_specular", {{"specularColorFactor", {1e9, -3, 0}}}},
        {"KHR_materials_clearcoat", {{"clearcoatFactor", 1e300}}},
        {"KHR_materials_sheen", {{"sheenColorFactor", "red"}}},
        {"KHR_materials_anisotropy", {{"anisotropyStrength", 2}, {"anisotropyRotation", 1e6}}},
        {"KHR_materials_iridescence", {{"iridescenceIor", 0}, {"iridescenceThicknessMaximum", -5}}}};
    const std::string material = material_in(import(file).scene);
    INFO(material);
    CHECK(holds(material,
                "metallic              = 1.0\nroughness             = 0.0\nior                   = 1.0\n"));
    CHECK(holds(material, "specular_color        = [1000.0, 0.0, 0.0]\n"));
    CHECK(holds(material, "iridescence_ior       = 1.0\niridescence_thickness = 0.0\n"));
}

TEST_CASE("specular-glossiness materials keep their diffuse colour, reflectance and gloss") {
    File file;
    file.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    file.material()["extensions"] = {{"KHR_materials_pbrSpecularGlossiness",
                                      {{"diffuseTexture", file.texture(plain_png({255, 0, 0, 255}))},
                                       {"specularFactor", {0.25, 0.25, 0.25}},
                                       {"glossinessFactor", 0.5}}}};
    const Imported imported = import(file);
    CHECK(holds(imported.scene, "model = \"specular-glossiness\""));
    CHECK(holds(material_in(imported.scene), "specular_color = 0.25\nglossiness     = 0.5\n"));
    CHECK(imported.middle()[0] > 100);
    CHECK(imported.middle()[2] < 60);
    CHECK_FALSE(holds(imported.result.err, "KHR_materials_pbrSpecularGlossiness"));
}

TEST_CASE(
    "unlit materials have their colour in the picture, under chosen lights, the studio and the file's own") {
    File file;
    file.json["extensionsUsed"] = {"KHR_materials_unlit"};
    file.material()["extensions"] = {{"KHR_materials_unlit", Json::object()}};
    // Of 255, 128 and 29 in sRGB.
    file.pbr() = {{"baseColorFactor", {1, 0.2158605, 0.0122866, 1}}};
    const Pixel expected{255, 128, 29, 255};
    const auto is_expected = [&](const Pixel& p) {
        for (std::size_t k = 0; k < 3; ++k)
            if (std::abs(p[k] - expected[k]) > 1) return false;
        return true;
    };
    const Imported imported = import(file);
    CHECK(holds(imported.scene, "model = \"unlit\""));
    CHECK(is_expected(imported.middle()));
    CHECK_FALSE(holds(imported.result.err, "KHR_materials_unlit"));
    CHECK(is_expected(import(file, "").middle()));
    file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "directional"}}}}}}};
    file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    CHECK(is_expected(import(file).middle()));
}

TEST_CASE("a material with a mask is cut out along its texture's opacity") {
    std::vector<Pixel> pixels(64, Pixel{255, 255, 255, 0});
    for (int y = 2; y < 6; ++y)
        for (int x = 2; x < 6; ++x) pixels[static_cast<std::size_t>(8 * y + x)] = {20, 200, 20, 255};
    File file;
    file.material()["alphaMode"] = "MASK";
    file.pbr() = {{"metallicFactor", 0}, {"baseColorTexture", file.texture(png(8, 8, pixels))}};
    const Imported imported = import(file);
    CHECK(holds(imported.scene,
                "= { texture = \"a_textures/texture0.png\", channel = \"a\" }\nopacity_cutoff = 0.5\n"));
    CHECK_FALSE(holds(imported.result.err, "opacity"));
    const Pixel background = imported.at(0, 0);
    CHECK(imported.middle()[1] > imported.middle()[0] + 50);
    int greenish = 0, others = 0;
    for (int y = 0; y < 60; ++y)
        for (int x = 0; x < 80; ++x) {
            const Pixel p = imported.at(x, y);
            if (p == background) continue;
            (p[1] > p[0] ? greenish : others) += 1;
        }
    CHECK(greenish > 300);
    CHECK(others < greenish / 10);

    SECTION("a surface that is opaque everywhere has no opacity") {
        file.material()["alphaCutoff"] = 0.0;
        CHECK_FALSE(holds(import(file).scene, "opacity"));
        file.material().erase("alphaMode");
        CHECK_FALSE(holds(import(file).scene, "opacity"));
        File whole;
        whole.material()["alphaMode"] = "BLEND";
        whole.pbr() = {{"metallicFactor", 0}, {"baseColorTexture", whole.texture(plain_png({9, 9, 9, 255}))}};
        CHECK_FALSE(holds(import(whole).scene, "opacity"));
    }
    SECTION("the factor of the colour multiplies the texture's opacity") {
        file.material()["alphaCutoff"] = 0.25;
        file.pbr()["baseColorFactor"] = {1, 1, 1, 0.5};
        CHECK(holds(import(file).scene, "channel = \"a\", scale = 0.5 }\nopacity_cutoff = 0.25\n"));
    }
    SECTION("a mask that nothing reaches leaves nothing") {
        file.material()["alphaCutoff"] = 1.5;
        file.pbr() = {{"metallicFactor", 0}};
        const Folder folder;
        folder.write("a.glb", file.glb());
        const CommandResult printed = folder.run("import a.glb -o -");
        INFO(printed.err);
        CHECK(holds(printed.out, "= 0.0\nopacity_cutoff = 1.0\n"));
    }
}

TEST_CASE("a material that is blended covers what is behind it by its opacity") {
    File glass;
    glass.material()["alphaMode"] = "BLEND";
    glass.pbr() = {{"metallicFactor", 0}, {"baseColorFactor", {1, 0, 0, 0.25}}};
    const Imported quarter = import(glass);
    CHECK(holds(quarter.scene, "opacity   = 0.25\n"));
    CHECK_FALSE(holds(quarter.result.err, "opacity"));
    const Pixel background = quarter.at(0, 0), middle = quarter.middle();
    CHECK(middle[2] < background[2]);
    CHECK(middle[2] > background[2] / 2);
    glass.pbr()["baseColorTexture"] = glass.texture(plain_png({255, 255, 255, 51}));
    CHECK(holds(import(glass).scene, "opacity   = 0.05\n"));
}

TEST_CASE("a file with a light of its own gets a little ambient light") {
    File file;
    file.pbr() = {{"metallicFactor", 0}};
    file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "directional"}}}}}}};
    // From behind.
    file.json["nodes"].push_back(
        {{"rotation", {0, 1, 0, 0}}, {"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    const Imported imported = import(file);
    CHECK(holds(imported.scene, "type      = \"ambient\""));
    CHECK(imported.middle()[0] > 20);
    CHECK(imported.middle()[0] < 150);
}

TEST_CASE("a light of the file's own may be inside its model") {
    File file;
    file.json["extensions"] = {{"KHR_lights_punctual", {{"lights", {{{"type", "point"}}}}}}};
    file.json["nodes"].push_back({{"extensions", {{"KHR_lights_punctual", {{"light", 0}}}}}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    // A tetrahedron around the origin.
    file.primitive()["attributes"] = {
        {"POSITION", file.floats("VEC3", {2, 2, 2, -2, -2, 2, -2, 2, -2, 2, -2, -2})}};
    file.primitive()["indices"] = file.integers({0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3});
    import(file);
}

TEST_CASE("a glTF mesh without normals has facets, and one with normals does not") {
    CHECK(holds(import(File(false)).scene, "crease_angle        = 0.0\n"));
    CHECK_FALSE(holds(import(File(true)).scene, "crease_angle"));
}

TEST_CASE("materials that are not double-sided are visible only from the front") {
    File file;
    // A room whose walls face inwards, around a red square that faces the observer.
    file.primitive()["attributes"] = {
        {"POSITION", file.floats("VEC3", {-4, -4, -4, 4, -4, -4, 4, 4, -4, -4, 4, -4,
                                          -4, -4, 4,  4, -4, 4,  4, 4, 4,  -4, 4, 4})}};
    file.primitive()["indices"] = file.integers({0, 1, 2, 0, 2, 3, 4, 6, 5, 4, 7, 6, 0, 5, 1, 0, 4, 5,
                                                 3, 2, 6, 3, 6, 7, 0, 3, 7, 0, 7, 4, 1, 6, 2, 1, 5, 6});
    file.json["materials"] = {
        {{"name", "wall"}, {"pbrMetallicRoughness", {{"metallicFactor", 0}}}},
        {{"name", "sign"},
         {"doubleSided", true},
         {"pbrMetallicRoughness", {{"metallicFactor", 0}, {"baseColorFactor", {1, 0, 0, 1}}}}}};
    const std::size_t square = file.floats("VEC3", {-2, -2, 0, 2, -2, 0, 2, 2, 0, -2, 2, 0});
    file.json["meshes"].push_back({{"primitives",
                                    {{{"attributes", {{"POSITION", square}}},
                                      {"indices", file.integers({0, 1, 2, 0, 2, 3})},
                                      {"material", 1}}}}});
    file.json["nodes"].push_back({{"mesh", 1}});
    file.json["scenes"][0]["nodes"] = {0, 1};
    const Imported imported = import(file);
    CHECK(imported.middle()[0] > imported.middle()[1] + 60);
    CHECK_FALSE(holds(imported.result.err, "inside out"));
}

TEST_CASE("a single-sided plane that faces away from the observer is still drawn") {
    File file;
    file.material() = {{"pbrMetallicRoughness", {{"metallicFactor", 0}}}};
    CHECK(holds(import(file).scene, "sides               = \"front\""));
    file.json["nodes"][0]["rotation"] = {0, 1, 0, 0};
    const Imported turned = import(file);
    CHECK(holds(turned.result.err, "face away from the observer, so both sides are drawn"));
    CHECK(turned.middle() != turned.at(0, 0));
}

TEST_CASE("losses in materials are reported in one line per kind, with a count") {
    File file;
    const Json volume = {{"extensions", {{"KHR_materials_volume", {{"thicknessFactor", 1}}}}}};
    file.json["materials"] = {volume, volume, volume};
    for (int i = 1; i < 3; ++i) {
        Json more = file.primitive();
        more["material"] = i;
        file.json["meshes"][0]["primitives"].push_back(more);
    }
    const Imported imported = import(file);
    CHECK(holds(imported.result.err, "the extension 'KHR_materials_volume' of 3 materials is left out\n"));

    File harmless;
    harmless.pbr() = {{"metallicFactor", 0},
                      {"baseColorFactor", {1, 1, 1, 0.3}},
                      {"baseColorTexture", harmless.texture(plain_png({255, 0, 0, 90}))}};
    harmless.pbr()["baseColorTexture"]["extensions"] = {
        {"KHR_texture_transform", {{"offset", {0, 0}}, {"scale", {1, 1}}, {"rotation", 0}}}};
    const std::string said = import(harmless).result.err;
    CHECK_FALSE(holds(said, "opacity"));
    CHECK_FALSE(holds(said, "KHR_texture_transform"));
}

TEST_CASE("damaged pictures in a glTF file are reported, by number for materials without a name") {
    File file;
    const std::string whole = png(8, 8, std::vector<Pixel>(64, Pixel{0, 255, 0, 255}));
    file.pbr() = {{"metallicFactor", 0},
                  {"baseColorFactor", {1, 0, 0, 1}},
                  {"baseColorTexture", file.texture(whole.substr(0, whole.size() / 2))}};
    const Imported imported = import(file);
    CHECK(holds(imported.result.err, "a texture of material 0 is left out: "));
    CHECK_FALSE(holds(imported.scene, "texture ="));
    CHECK(imported.middle()[0] > 100);
    CHECK(imported.middle()[1] < 50);
}

TEST_CASE("warnings about a model do not quote a generated scene") {
    const Folder folder;
    File file;
    file.json["extensionsUsed"] = {"EXT_of_ours"};
    folder.write("a.glb", file.glb());
    const CommandResult rendered = expect(folder.run("render a.glb -o a.ppm"), 0, {"a.glb: warning: object"});
    CHECK_FALSE(holds(rendered.err, " | "));
    const CommandResult checked = folder.run("check --json a.glb");
    CHECK(holds(checked.out, "\"line\": 0"));
}
