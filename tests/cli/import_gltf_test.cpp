// candela import: the materials of glTF files, and faulty files.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_file.h"
#include "support/text.h"

namespace {

using Json = nlohmann::json;

std::string big_endian(std::uint32_t value) {
    std::string bytes;
    for (int shift = 24; shift >= 0; shift -= 8) bytes += static_cast<char>(value >> shift & 255);
    return bytes;
}

std::string chunk(const std::string& type_and_data) {
    std::uint32_t crc = 0xffff'ffffu;
    for (const char c : type_and_data) {
        crc ^= static_cast<unsigned char>(c);
        for (int k = 0; k < 8; ++k) crc = crc >> 1 ^ (0xedb8'8320u & (0u - (crc & 1)));
    }
    return big_endian(static_cast<std::uint32_t>(type_and_data.size() - 4)) + type_and_data +
           big_endian(~crc);
}

using Pixel = std::array<std::uint8_t, 4>;

/// A PNG with opacity, not compressed.
std::string png(int width, int height, const std::vector<Pixel>& pixels) {
    std::string raw;
    for (int y = 0; y < height; ++y) {
        raw += '\0';
        for (int x = 0; x < width; ++x)
            for (const std::uint8_t v : pixels[static_cast<std::size_t>(y * width + x)])
                raw += static_cast<char>(v);
    }
    std::uint32_t a = 1, b = 0;
    for (const char c : raw) {
        a = (a + static_cast<unsigned char>(c)) % 65521;
        b = (b + a) % 65521;
    }
    const auto size = static_cast<std::uint16_t>(raw.size());
    const std::string stored = {'\x78',
                                '\x01',
                                '\x01',
                                static_cast<char>(size & 255),
                                static_cast<char>(size >> 8),
                                static_cast<char>(~size & 255),
                                static_cast<char>(~size >> 8 & 255)};
    return "\x89PNG\r\n\x1a\n" +
           chunk("IHDR" + big_endian(static_cast<std::uint32_t>(width)) +
                 big_endian(static_cast<std::uint32_t>(height)) + std::string("\x08\x06\0\0\0", 5)) +
           chunk("IDAT" + stored + raw + big_endian(b << 16 | a)) + chunk("IEND");
}

/// A GLB file: a square from (-1, -1) to (1, 1) that faces +z, or its replacement.
class File : public GltfFile {
  public:
    explicit File(bool has_normals = true)
        : GltfFile(Json::parse(R"({"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {}, "material": 0}]}], "materials": [{"doubleSided": true}]})")) {
        primitive()["attributes"]["POSITION"] = floats("VEC3", {-1, -1, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0});
        primitive()["attributes"]["TEXCOORD_0"] = floats("VEC2", {0, 1, 1, 1, 1, 0, 0, 0});
        if (has_normals)
            primitive()["attributes"]["NORMAL"] = floats("VEC3", {0, 0, 1, 0, 0, 1, 0, 0, 1, 0, 0, 1});
        primitive()["indices"] = integers({0, 1, 2, 0, 2, 3});
    }

    Json& primitive() { return json["meshes"][0]["primitives"][0]; }
    Json& material() { return json["materials"][0]; }
    Json& pbr() { return material()["pbrMetallicRoughness"]; }

    /// A texture of its own.
    Json texture(const std::string& image) {
        const std::size_t at = view(image.data(), image.size());
        json["images"].push_back({{"bufferView", at}, {"mimeType", "image/png"}});
        json["textures"].push_back({{"source", json["images"].size() - 1}});
        return {{"index", json["textures"].size() - 1}};
    }
};

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

Imported import(File file) {
    const Folder folder({{"a.glb", file.glb()}});
    Imported imported{folder.run("import a.glb"), "", ""};
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

TEST_CASE("import uses the mean of a texture of metalness and roughness") {
    File factors;
    factors.pbr() = {{"metallicFactor", 0.0}, {"roughnessFactor", 0.5}};
    File textured;
    // Roughness is green, metalness is blue, and neither is encoded.
    textured.pbr() = {{"metallicRoughnessTexture",
                       textured.texture(png(2, 1, {Pixel{9, 255, 0, 255}, Pixel{200, 0, 0, 255}}))}};
    const Imported imported = import(textured);
    CHECK(material_in(imported.scene) == material_in(import(factors).scene));
    CHECK(holds(imported.result.err, "only the mean of a texture of metalness and roughness is used"));
    CHECK(holds(imported.result.out + imported.result.err, "0 textures"));
}

TEST_CASE("a metal's highlights have the mean colour of its texture and of its vertices") {
    File factors;
    factors.pbr() = {{"baseColorFactor", {1, 0.5, 0.25, 1}}, {"roughnessFactor", 0.5}};
    CHECK(holds(import(factors).scene, "ks        = [1.0, 0.5, 0.25]"));
    File textured;
    textured.pbr() = {{"baseColorTexture", textured.texture(plain_png({255, 188, 0, 255}))},
                      {"baseColorFactor", {0.5, 1, 1, 1}}};
    CHECK(holds(import(textured).scene, "ks        = [0.5, 0.5029, 0.0]"));
    File vertices;
    vertices.primitive()["attributes"]["COLOR_0"] =
        vertices.floats("VEC3", {1, 0.5f, 0, 1, 0.5f, 0, 0, 0.5f, 0, 0, 0.5f, 0});
    const Imported imported = import(vertices);
    CHECK(holds(imported.scene, "ks        = [0.5, 0.5, 0.0]"));
    CHECK(holds(imported.result.err, "the highlights of a metal have the mean colour of its vertices"));
}

TEST_CASE("specular-glossiness materials are ggx with a diffuse colour and highlights") {
    File file;
    file.json["extensionsUsed"] = {"KHR_materials_pbrSpecularGlossiness"};
    file.material()["extensions"] = {{"KHR_materials_pbrSpecularGlossiness",
                                      {{"diffuseTexture", file.texture(plain_png({255, 0, 0, 255}))},
                                       {"specularFactor", {0.25, 0.25, 0.25}},
                                       {"glossinessFactor", 0.5}}}};
    const Imported imported = import(file);
    CHECK(holds(material_in(imported.scene), "kd        = 0.75\nks        = 0.25\nroughness = 0.25\n"));
    CHECK(imported.middle()[0] > 100);
    CHECK(imported.middle()[2] < 60);
    CHECK_FALSE(holds(imported.result.err, "KHR_materials_pbrSpecularGlossiness"));
}

TEST_CASE("a material with a mask is cut out along its texture's opacity") {
    std::vector<Pixel> pixels(64, Pixel{255, 255, 255, 0});
    for (int y = 2; y < 6; ++y)
        for (int x = 2; x < 6; ++x) pixels[static_cast<std::size_t>(8 * y + x)] = {20, 200, 20, 255};
    File file;
    file.material()["alphaMode"] = "MASK";
    file.pbr() = {{"metallicFactor", 0}, {"baseColorTexture", file.texture(png(8, 8, pixels))}};
    const Imported imported = import(file);
    CHECK(holds(imported.scene, "cutout              = \"a_textures/texture0_opacity_0.pgm\"\n"));
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

    SECTION(
        "a surface that is opaque everywhere stays whole, and so does a blended one that is hardly ever "
        "opaque") {
        file.material()["alphaCutoff"] = 0.0;
        CHECK_FALSE(holds(import(file).scene, "cutout"));
        File glass;
        glass.material()["alphaMode"] = "BLEND";
        glass.pbr() = {{"metallicFactor", 0},
                       {"baseColorTexture", glass.texture(plain_png({255, 255, 255, 90}))}};
        const Imported whole = import(glass);
        CHECK_FALSE(holds(whole.scene, "cutout"));
        CHECK(holds(whole.result.err, "the opacity of a material is left out"));
    }
    SECTION("a printed scene has no place for the outline") {
        const Folder folder;
        File external = file;
        folder.write("leaf.png", png(8, 8, pixels));
        external.json["images"] = {{{"uri", "leaf.png"}}};
        folder.write("a.glb", external.glb());
        const CommandResult printed =
            expect(folder.run("import a.glb -o -"), 0,
                   {"transparent parts are not cut out: that needs a file next to the scene"});
        CHECK_FALSE(holds(printed.out, "cutout"));
    }
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
    const Json map = file.texture(plain_png({128, 128, 255, 255}));
    file.json["materials"] = {{{"normalTexture", map}}, {{"normalTexture", map}}, {{"normalTexture", map}}};
    for (int i = 1; i < 3; ++i) {
        Json more = file.primitive();
        more["material"] = i;
        file.json["meshes"][0]["primitives"].push_back(more);
    }
    const Imported imported = import(file);
    CHECK(holds(imported.result.err, "3 normal maps are left out\n"));

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
    CHECK_FALSE(holds(imported.scene, "color_texture"));
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
