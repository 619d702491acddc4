// Numbers of vertices in GLB files, against the numbers of the meshes that they come from.
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <cstring>
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

struct Glb {
    Json json;
    std::string buffer;

    const Json& attributes() const { return json["meshes"][0]["primitives"][0]["attributes"]; }
    const Json& material() const { return json["materials"][0]; }
    std::vector<float> floats(const char* attribute) const {
        const Json& accessor = json["accessors"][attributes()[attribute].get<std::size_t>()];
        REQUIRE(accessor["componentType"] == 5126);
        const std::string type = accessor["type"];
        const std::size_t width = type == "SCALAR" ? 1 : static_cast<std::size_t>(type.back() - '0');
        const Json& view = json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
        std::vector<float> numbers(accessor["count"].get<std::size_t>() * width);
        REQUIRE(view["byteLength"] == numbers.size() * sizeof(float));
        std::memcpy(numbers.data(), buffer.data() + view["byteOffset"].get<std::size_t>(),
                    numbers.size() * sizeof(float));
        return numbers;
    }
};

Glb read(const std::string& bytes) {
    std::uint32_t json = 0;
    std::memcpy(&json, bytes.data() + 12, sizeof json);
    return {Json::parse(bytes.substr(20, json)), bytes.substr(28 + json)};
}

/// A square whose wear is 0, 1, 0.5 and 2 at its corners, white but for one.
constexpr const char* k_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float wear\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar "
    "alpha\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 0 255 255 255 255\n1 -1 0 1 255 0 255 51\n1 1 0 0.5 255 255 255 102\n-1 1 0 2 255 255 255 0\n"
    "3 0 1 2\n3 0 2 3\n";

CommandResult generate(const Folder& folder, const std::string& material, const std::string& more = {}) {
    folder.write("square.ply", k_ply);
    folder.write("scene.toml",
                 "version = 1\nshading = { model = \"phong\" }\nobserver = { position = [0, 0, 4], look_at = "
                 "[0, 0, 0] }\n[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n[[object]]\nname = "
                 "\"square\"\ntype = \"mesh\"\nfile = \"square.ply\"\nreflection = \"metallic-roughness\"\n" +
                     more + "[object.material]\n" + material + "\n");
    return folder.run("generate scene.toml --target gltf -o .");
}

Glb generated(const Folder& folder, const std::string& material, const std::string& more = {}) {
    succeeded(generate(folder, material, more));
    return read(folder.read("scene.glb"));
}

}  // namespace

TEST_CASE("target/gltf: the alpha of vertices comes back as it went in, times a picture's and a factor") {
    const Folder folder;
    GltfSquare file;
    file.primitive()["attributes"]["COLOR_0"] =
        file.floats("VEC4", {1, 1, 1, 0, 1, 0.5, 1, 0.25, 1, 1, 1, 1, 0.125, 1, 1, 0.5});
    file.pbr() = {{"metallicFactor", 0}, {"baseColorFactor", {1, 1, 1, 0.75}}};
    file.material()["alphaMode"] = "BLEND";
    const auto imported = [&](const std::string& glb) {
        succeeded(folder.run("import " + glb + " --force -o scene.toml"));
        return folder.read("scene.toml");
    };
    const auto there_and_back = [&] {
        folder.write("a.glb", file.glb());
        const std::string scene = imported("a.glb");
        succeeded(folder.run("generate scene.toml --target gltf -o made --approximate --quiet"));
        const Glb glb = read(folder.read("made/scene.glb"));
        CHECK(glb.floats("COLOR_0") ==
              std::vector<float>{1, 1, 1, 0, 1, 0.5, 1, 0.25, 1, 1, 1, 1, 0.125, 1, 1, 0.5});
        CHECK(glb.material()["pbrMetallicRoughness"]["baseColorFactor"] == Json{1.0, 1.0, 1.0, 0.75});
        CHECK(glb.material()["alphaMode"] == file.material()["alphaMode"]);
        const std::string again = imported("made/scene.glb");
        const auto opacity_of = [](const std::string& text) {
            const std::size_t at = text.find("\nopacity");
            return text.substr(at, text.find('\n', at + 1) - at);
        };
        CHECK(holds(opacity_of(scene), "attribute"));
        CHECK(opacity_of(again) == opacity_of(scene));
    };
    there_and_back();
    file.pbr()["baseColorTexture"] = file.texture(png(2, 1, {{51, 102, 255, 255}, {10, 20, 30, 100}}));
    file.material()["alphaMode"] = "MASK";
    there_and_back();
}

TEST_CASE("target/gltf: any number of the vertices that gives an opacity or a colour is in their colours") {
    const Folder folder;
    const Glb of_alpha = generated(folder, "opacity = { attribute = \"color\", channel = \"a\" }");
    CHECK(of_alpha.floats("COLOR_0") ==
          std::vector<float>{1, 1, 1, 1, 1, 0, 1, 0.2f, 1, 1, 1, 0.4f, 1, 1, 1, 0});
    CHECK(of_alpha.material()["alphaMode"] == "BLEND");
    const Glb of_wear =
        generated(folder, "opacity = { attribute = \"wear\", channel = \"r\", scale = -0.25, offset = 0.5 }");
    CHECK(of_wear.floats("COLOR_0") ==
          std::vector<float>{1, 1, 1, 0.5, 1, 0, 1, 0.25, 1, 1, 1, 0.375, 1, 1, 1, 0});
    CHECK(of_wear.material()["pbrMetallicRoughness"]["baseColorFactor"][3] == 1);
    const Glb colored =
        generated(folder, "",
                  "vertex_colors = false\ncolor = { attribute = \"wear\", scale = [0.5, 0, 0.25], "
                  "channel = \"r\" }\n");
    CHECK(colored.floats("COLOR_0") == std::vector<float>{0, 0, 0, 0.5, 0, 0.25, 0.25, 0, 0.125, 1, 0, 0.5});
    CHECK_FALSE(colored.material().contains("alphaMode"));
    SECTION("unless it is out of range at a vertex, which makes it approximate") {
        expect(generate(folder, "opacity = { attribute = \"wear\", channel = \"r\" }"), 1,
               {"the opacity of object square is brought into its range at vertices"});
    }
}

TEST_CASE("target/gltf: parameters that vertices give become attributes by their names, and means") {
    const Folder folder;
    const char* const material =
        "roughness = { attribute = \"wear\", channel = \"r\", scale = 0.25, offset = 0.125 }\nemission = { "
        "attribute = \"color\" }\nanisotropy_rotation = { attribute = \"wear\", scale = 90 }\n"
        "anisotropy_strength = 0.5";
    expect(generate(folder, material), 1,
           {"the numbers of vertices that give 'roughness' of object square become the attribute _ROUGHNESS",
            "'emission'", "--approximate"});
    succeeded(folder.run("generate scene.toml --target gltf -o . --approximate"));
    const Glb glb = read(folder.read("scene.glb"));
    CHECK(glb.floats("_ROUGHNESS") == std::vector<float>{0.125, 0.375, 0.25, 0.625});
    CHECK(glb.floats("_EMISSION") == std::vector<float>{1, 1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1});
    const std::vector<float> degrees = glb.floats("_ANISOTROPY_ROTATION");
    for (std::size_t i = 0; i < 4; ++i)
        CHECK(std::abs(degrees[i] - std::array{0.0f, 90.0f, 45.0f, 180.0f}[i]) < 1e-4f);
    // The mean of the four.
    CHECK(glb.material()["pbrMetallicRoughness"]["roughnessFactor"] == 0.34375);
    CHECK(glb.material()["emissiveFactor"][1].get<double>() == 0.75);
}
