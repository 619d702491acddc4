// Textures of parameters as maps of GLB files, against their values computed by hand.
#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/text.h"

namespace {

using Json = nlohmann::json;

struct Glb {
    Json json;
    std::string buffer;

    const Json& material() const { return json["materials"][0]; }
    /// The file of a map's picture.
    std::string file(const Json& map) const {
        const Json& image =
            json["images"][json["textures"][map["index"].get<std::size_t>()]["source"].get<std::size_t>()];
        const Json& view = json["bufferViews"][image["bufferView"].get<std::size_t>()];
        return buffer.substr(view["byteOffset"], view["byteLength"]);
    }
};

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// `name`: of the object, whose material it is.
std::string scene(const std::string& material, const std::string& reflection = "metallic-roughness") {
    return "version = 1\nshading = {model = \"phong\"}\nobserver = {position = [0, 0, 4], look_at = [0, 0, "
           "0]}\n[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n[[object]]\nname = "
           "\"ball\"\ntype = \"sphere\"\nradius = 1\nreflection = \"" +
           reflection + "\"\n[object.material]\n" + material + "\n";
}

Glb generated(const Folder& folder, const std::string& text, const std::vector<std::string>& more = {}) {
    folder.write("scene.toml", text);
    succeeded(folder.run("generate scene.toml --target gltf -o . --quiet", more));
    const std::string bytes = folder.read("scene.glb");
    const std::size_t json = number_at(bytes, 12);
    return {Json::parse(bytes.substr(20, json)), bytes.substr(28 + json)};
}

std::vector<std::uint8_t> pixels_of(const std::string& png, bool with_opacity = false) {
    png_image image{};
    image.version = PNG_IMAGE_VERSION;
    REQUIRE(png_image_begin_read_from_memory(&image, png.data(), png.size()) != 0);
    image.format = with_opacity ? PNG_FORMAT_RGBA : PNG_FORMAT_RGB;
    std::vector<std::uint8_t> bytes(PNG_IMAGE_SIZE(image));
    REQUIRE(png_image_finish_read(&image, nullptr, bytes.data(), 0, nullptr) != 0);
    return bytes;
}

bool is_near(const Json& a, double b) { return std::abs(a.get<double>() - b) <= 1e-6 * std::max(1.0, b); }

/// A binary pixmap of one row.
std::string row(const std::vector<int>& bytes) {
    std::string file = fmt::format("P6\n{} 1\n255\n", bytes.size() / 3);
    for (const int byte : bytes) file += static_cast<char>(byte);
    return file;
}

/// A PNG file of many colours, so that it is not read alike in both encodings.
Folder folder_with_picture() {
    Folder folder;
    succeeded(folder.run("render -o picture.png --width 12 --height 8"));
    return folder;
}

}  // namespace

TEST_CASE("target/gltf: a picture whose channels are those of a map is embedded as it is, once") {
    const Folder folder = folder_with_picture();
    const Glb glb = generated(folder, scene(R"(metallic = { texture = "picture.png", channel = "b" }
roughness = { texture = "picture.png", channel = "g", scale = 0.5 }
specular_color = { texture = "picture.png", scale = [2, 1, 0.5] }
clearcoat = { texture = "picture.png", wrap = "clamp" }
iridescence = 1
iridescence_thickness = { texture = "picture.png", channel = "g", scale = 300, offset = 100 })"));
    CHECK(glb.json["images"].size() == 1);
    const Json& pbr = glb.material()["pbrMetallicRoughness"];
    CHECK(glb.file(pbr["metallicRoughnessTexture"]) == folder.read("picture.png"));
    CHECK(pbr["metallicFactor"] == 1);
    CHECK(pbr["roughnessFactor"] == 0.5);
    CHECK_FALSE(pbr["metallicRoughnessTexture"].contains("extensions"));
    const Json& extensions = glb.material()["extensions"];
    const Json& specular = extensions["KHR_materials_specular"];
    CHECK(specular["specularColorFactor"] == Json{2, 1, 0.5});
    CHECK(specular["specularColorTexture"]["index"] == pbr["metallicRoughnessTexture"]["index"]);
    const Json& coat = extensions["KHR_materials_clearcoat"];
    CHECK(coat["clearcoatFactor"] == 1);
    const Json& texture = glb.json["textures"][coat["clearcoatTexture"]["index"].get<std::size_t>()];
    CHECK(glb.json["samplers"][texture["sampler"].get<std::size_t>()]["wrapT"] == 33071);
    const Json& film = extensions["KHR_materials_iridescence"];
    CHECK(film["iridescenceThicknessMinimum"] == 100);
    CHECK(film["iridescenceThicknessMaximum"] == 400);
    CHECK(film.contains("iridescenceThicknessTexture"));
}

TEST_CASE("target/gltf: a transform of a texture is KHR_texture_transform's, point by point") {
    const Folder folder = folder_with_picture();
    const Glb glb = generated(
        folder, scene("roughness = { texture = \"picture.png\", channel = \"g\", transform = { scale = [2, "
                      "-3], rotation = 30, offset = [0.1, 0.2] } }\nmetallic = 0"));
    const Json& transform = glb.material()["pbrMetallicRoughness"]["metallicRoughnessTexture"]["extensions"]
                                          ["KHR_texture_transform"];
    const double turn = transform["rotation"], c = std::cos(turn), s = std::sin(turn);
    const double degrees = std::numbers::pi / 180, our_c = std::cos(30 * degrees),
                 our_s = std::sin(30 * degrees);
    for (const auto& [u, v] : {std::pair(0.0, 0.0), {1.0, 0.0}, {0.0, 1.0}, {0.3, 0.8}}) {
        const double ours_u = our_c * 2 * u - our_s * -3 * v + 0.1,
                     ours_v = our_s * 2 * u + our_c * -3 * v + 0.2;
        // Down from the top.
        const double across = transform["scale"][0].get<double>() * u,
                     down = transform["scale"][1].get<double>() * (1 - v);
        CHECK(std::abs(c * across + s * down + transform["offset"][0].get<double>() - ours_u) < 1e-5);
        CHECK(std::abs(1 - (-s * across + c * down + transform["offset"][1].get<double>()) - ours_v) < 1e-5);
    }
}

TEST_CASE("target/gltf: other textures of parameters are computed into pictures of a map's channels") {
    Folder folder;
    folder.write("p.ppm", row({0, 51, 255, 102, 204, 0}));
    folder.write("q.ppm", row({255, 0, 0, 51, 0, 0}));
    const Glb glb = generated(folder, scene(R"(metallic = 0.5
roughness = { texture = "p.ppm", channel = "r", scale = 0.5, offset = 0.2 }
specular = { texture = "p.ppm", channel = "g" }
specular_color = { texture = "p.ppm", channel = "r", scale = 5, offset = 0.5 }
anisotropy_strength = { texture = "q.ppm" }
iridescence = { texture = "q.ppm", scale = -1, offset = 1 }
iridescence_thickness = { texture = "q.ppm", scale = -500, offset = 700 })"));
    // 0.2 and 0.2 + 0.5 * 0.4 of at most 0.4: halves of 255. The metal is a constant.
    const Json& pbr = glb.material()["pbrMetallicRoughness"];
    CHECK(is_near(pbr["roughnessFactor"], 0.4));
    CHECK(pbr["metallicFactor"] == 0.5);
    CHECK(pixels_of(glb.file(pbr["metallicRoughnessTexture"])) ==
          std::vector<std::uint8_t>{255, 128, 255, 255, 255, 255});
    const Json& extensions = glb.material()["extensions"];
    const Json& specular = extensions["KHR_materials_specular"];
    CHECK(specular["specularFactor"] == 1);
    CHECK(pixels_of(glb.file(specular["specularTexture"]), true) ==
          std::vector<std::uint8_t>{255, 255, 255, 51, 255, 255, 255, 204});
    // 0.5 and 2.5: a fifth, which is sRGB's 0.48453, and one.
    CHECK(is_near(specular["specularColorFactor"][1], 2.5));
    CHECK(pixels_of(glb.file(specular["specularColorTexture"])) ==
          std::vector<std::uint8_t>{124, 124, 124, 255, 255, 255});
    const Json& grain = extensions["KHR_materials_anisotropy"];
    CHECK(pixels_of(glb.file(grain["anisotropyTexture"])) ==
          std::vector<std::uint8_t>{255, 128, 255, 255, 128, 51});
    const Json& film = extensions["KHR_materials_iridescence"];
    CHECK(is_near(film["iridescenceFactor"], 0.8));
    CHECK(pixels_of(glb.file(film["iridescenceTexture"])) ==
          std::vector<std::uint8_t>{0, 255, 255, 255, 255, 255});
    CHECK(is_near(film["iridescenceThicknessMinimum"], 200));
    CHECK(is_near(film["iridescenceThicknessMaximum"], 600));
    CHECK(pixels_of(glb.file(film["iridescenceThicknessTexture"])) ==
          std::vector<std::uint8_t>{255, 0, 255, 255, 255, 255});

    const Glb glossy = generated(
        folder, scene("glossiness = { texture = \"p.ppm\", channel = \"g\" }", "specular-glossiness"));
    // One minus 0.2 and 0.8.
    const Json& rough = glossy.material()["pbrMetallicRoughness"];
    CHECK(is_near(rough["roughnessFactor"], 0.8));
    CHECK(pixels_of(glossy.file(rough["metallicRoughnessTexture"])) ==
          std::vector<std::uint8_t>{255, 255, 255, 255, 64, 255});
}

TEST_CASE("target/gltf: parameters for which glTF has no map are refused by name, or become their means") {
    Folder folder;
    folder.write("p.ppm", row({51, 0, 0, 255, 0, 0}));
    const auto refused = [&](const std::string& text, const std::string& parameter) {
        folder.write("scene.toml", text);
        expect(folder.run("generate scene.toml --target gltf -o ."), 1,
               {"the texture of '" + parameter + "' of object ball becomes its mean"});
        CHECK_FALSE(folder.has("scene.glb"));
    };
    const std::string index = scene("ior = { texture = \"p.ppm\", offset = 1 }");
    refused(index, "ior");
    const Glb glb = generated(folder, index, {"--approximate"});
    CHECK(is_near(glb.material()["extensions"]["KHR_materials_ior"]["ior"], 1.6));
    std::filesystem::remove(folder / "scene.glb");
    const std::string moved = scene(
        "roughness = { texture = \"p.ppm\" }\nmetallic = { texture = \"p.ppm\", transform = { scale = [2, 1] "
        "} "
        "}");
    refused(moved, "metallic");
    CHECK(is_near(
        generated(folder, moved, {"--approximate"}).material()["pbrMetallicRoughness"]["metallicFactor"],
        0.6));
    std::filesystem::remove(folder / "scene.glb");
    refused(scene("kd = { texture = \"p.ppm\" }", "lambert"), "kd");
}

TEST_CASE("target/gltf: emission has a strength where it exceeds 1, with any reflection model") {
    const Folder folder;
    for (const char* const reflection : {"metallic-roughness", "phong"}) {
        const Glb weak =
            generated(folder, scene("emission = [255, 128, 0]\nemission_strength = 0.5", reflection),
                      {"--approximate"});
        CHECK(is_near(weak.material()["emissiveFactor"][0], 0.5));
        CHECK(is_near(weak.material()["emissiveFactor"][1], 0.5 * 0.21586050));
        CHECK(weak.material()["emissiveFactor"][2] == 0);
        CHECK_FALSE(holds(weak.json.dump(), "emissive_strength"));
        const Glb strong = generated(
            folder, scene("emission = [255, 128, 0]\nemission_strength = 40", reflection), {"--approximate"});
        CHECK(is_near(strong.material()["emissiveFactor"][0], 1));
        CHECK(is_near(strong.material()["emissiveFactor"][1], 0.21586050));
        const Json& extension = strong.material()["extensions"]["KHR_materials_emissive_strength"];
        CHECK(extension["emissiveStrength"] == 40);
        CHECK(holds(strong.json["extensionsUsed"].dump(), "KHR_materials_emissive_strength"));
    }
    CHECK_FALSE(generated(folder, scene("metallic = 0")).material().contains("emissiveFactor"));
}

TEST_CASE("target/gltf: pictures of emission and occlusion are embedded as they are, or made") {
    const Folder folder = folder_with_picture();
    const Glb glb = generated(folder, scene(R"(emission = { texture = "picture.png", scale = [1, 0.5, 0.25] }
emission_strength = 2
occlusion = { texture = "picture.png", scale = 0.75, offset = 0.25 })"));
    CHECK(glb.json["images"].size() == 1);
    CHECK(glb.file(glb.material()["emissiveTexture"]) == folder.read("picture.png"));
    CHECK(glb.material()["emissiveFactor"] == Json{1, 0.5, 0.25});
    CHECK(glb.material()["occlusionTexture"]["strength"] == 0.75);
    SECTION("with the values that glTF has no factors for") {
        folder.write("row.ppm", row({0, 51, 255, 255, 102, 0}));
        const Glb made =
            generated(folder, scene(R"(emission = { texture = "row.ppm", offset = [0.5, 0, 0], scale = 0.5 }
occlusion = { texture = "row.ppm", channel = "g", scale = -1, offset = 1 })"));
        // Of 0 and 255 in red: 0.5 and 1.
        const auto emission = pixels_of(made.file(made.material()["emissiveTexture"]));
        CHECK(emission[0] == 188);
        CHECK(emission[3] == 255);
        CHECK(is_near(made.material()["emissiveFactor"][0], 1));
        const auto occlusion = pixels_of(made.file(made.material()["occlusionTexture"]));
        CHECK(occlusion[0] == 204);
        CHECK(occlusion[3] == 153);
        CHECK_FALSE(made.material()["occlusionTexture"].contains("strength"));
    }
    folder.write("scene.toml", scene("occlusion = 0.5"));
    expect(folder.run("generate scene.toml --target gltf -o out"), 1,
           {"the occlusion of object ball, which has no texture, is left out"});
}

TEST_CASE("target/gltf: opacity is the alpha of the colour, with any reflection model") {
    const Folder folder;
    for (const char* const reflection : {"metallic-roughness", "phong"}) {
        const Glb pane = generated(folder, scene("opacity = 0.25", reflection), {"--approximate"});
        CHECK(pane.material()["alphaMode"] == "BLEND");
        CHECK(pane.material()["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.25);
        CHECK_FALSE(pane.material().contains("alphaCutoff"));
        // A closed object that something is seen through has an inside.
        CHECK(pane.material()["doubleSided"] == true);
    }
    const Glb gone = generated(folder, scene("opacity = 0.25\nopacity_cutoff = 0.5"));
    CHECK(gone.material()["alphaMode"] == "MASK");
    CHECK(gone.material()["alphaCutoff"] == 0.5);
    CHECK_FALSE(generated(folder, scene("opacity = 1")).material().contains("alphaMode"));
    CHECK_FALSE(
        generated(folder, scene("opacity = 0.5\nopacity_cutoff = 0.5")).material().contains("alphaMode"));
    SECTION("a texture without a colour's is white with that alpha") {
        folder.write("row.ppm", row({0, 51, 255, 255, 102, 0}));
        const Glb made =
            generated(folder, scene(R"(opacity = { texture = "row.ppm", channel = "g", scale = 0.5 }
opacity_cutoff = 0.1)"));
        CHECK(made.material()["alphaMode"] == "MASK");
        const std::string file = made.file(made.material()["pbrMetallicRoughness"]["baseColorTexture"]);
        // Its header says that it has four channels.
        CHECK(file[25] == 6);
        CHECK(made.material()["pbrMetallicRoughness"]["baseColorFactor"][3] == 0.5);
    }
}
