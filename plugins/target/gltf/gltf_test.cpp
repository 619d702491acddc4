// GLB files, read back by hand and by `candela import`.
#include <fmt/format.h>

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

namespace fs = std::filesystem;

namespace {

using Json = nlohmann::json;

struct Glb {
    Json json;
    std::string buffer;
};

std::uint32_t number_at(const std::string& bytes, std::size_t at) {
    std::uint32_t number = 0;
    std::memcpy(&number, bytes.data() + at, sizeof number);
    return number;
}

/// Parses the file by section 4.4 of the specification.
Glb read_glb(const fs::path& file) {
    const std::string bytes = read_file(file);
    REQUIRE(bytes.starts_with("glTF"));
    REQUIRE(number_at(bytes, 4) == 2);
    REQUIRE(number_at(bytes, 8) == bytes.size());
    const std::size_t json = number_at(bytes, 12);
    REQUIRE(json % 4 == 0);
    REQUIRE(bytes.substr(16, 4) == "JSON");
    Glb glb{Json::parse(bytes.substr(20, json)), {}};
    if (20 + json == bytes.size()) return glb;
    REQUIRE(bytes.substr(24 + json, 4) == std::string("BIN\0", 4));
    glb.buffer = bytes.substr(28 + json);
    REQUIRE(glb.buffer.size() == number_at(bytes, 20 + json));
    return glb;
}

template <class T>
std::vector<T> numbers(const Glb& glb, const Json& accessor_index) {
    const Json& accessor = glb.json["accessors"][accessor_index.get<std::size_t>()];
    const Json& view = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()];
    const std::string type = accessor["type"];
    const std::size_t per_element = type == "VEC3" ? 3 : type == "VEC2" ? 2 : 1;
    std::vector<T> result(accessor["count"].get<std::size_t>() * per_element);
    REQUIRE(view["byteLength"] == result.size() * sizeof(T));
    std::memcpy(result.data(), glb.buffer.data() + view["byteOffset"].get<std::size_t>(),
                result.size() * sizeof(T));
    return result;
}

CommandResult generate(const Folder& folder, const std::string& scene,
                       const std::vector<std::string>& more = {}) {
    folder.write("scene.toml", scene);
    return folder.run("generate scene.toml --target gltf -o .", more);
}

Glb generated(const Folder& folder, const std::string& scene, const std::vector<std::string>& more = {}) {
    succeeded(generate(folder, scene, more));
    return read_glb(folder / "scene.glb");
}

/// The scene that `candela import` makes of it.
std::string imported(const Folder& folder) {
    succeeded(folder.run("import scene.glb -o back.toml --force"));
    return folder.read("back.toml");
}

bool is_near(const Json& a, double b) {
    return std::abs(a.get<double>() - b) <= 1e-6 * std::max(1.0, std::abs(b));
}

/// sRGB, IEC 61966-2-1.
double linear(double byte) {
    const double c = byte / 255;
    return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4);
}

const std::string k_view = R"(version = 1
shading = {model = "phong"}
reflection = {model = "lambert"}
[observer]
position = [1, 2, 4]
look_at = [0, 0.5, 0]
fov = 40
[image]
width = 200
height = 100
background = [40, 43, 50]
[[light]]
name = "lamp"
type = "point"
color = [255, 200, 100]
intensity = 12
position = [1.5, 3, 2]
[[light]]
name = "sun"
type = "directional"
color = [250, 240, 230]
intensity = 0.5
direction = [1, -2, -2]
)";

const std::string k_scene = k_view + R"([[object]]
name = "leaf"
type = "mesh"
file = "leaf.obj"
color = [200, 100, 50]
material = {kd = [0.5, 1, 0.25], ka = 0}
)";

Folder folder_with_leaf() {
    const Folder folder;
    folder.write("leaf.obj",
                 "v -0.1 0.2 0.3\nv 1.1 0 0.7\nv 0.4 1.3 -0.2\nvn 0 0 1\nvn 0.6 0 0.8\nvn 0 0.6 0.8\nf 1//1 "
                 "2//2 3//3\n");
    return folder;
}

}  // namespace

TEST_CASE(
    "target/gltf: positions and normals are the mesh's own floats, base colour is kd times the colour") {
    const Glb glb = generated(folder_with_leaf(), k_scene);
    const Json& primitive = glb.json["meshes"][0]["primitives"][0];
    CHECK(numbers<float>(glb, primitive["attributes"]["POSITION"]) ==
          std::vector<float>{-0.1f, 0.2f, 0.3f, 1.1f, 0, 0.7f, 0.4f, 1.3f, -0.2f});
    CHECK(numbers<std::uint32_t>(glb, primitive["indices"]) == std::vector<std::uint32_t>{0, 1, 2});
    const std::vector<float> normals = numbers<float>(glb, primitive["attributes"]["NORMAL"]);
    const std::vector<float> expected{0, 0, 1, 0.6f, 0, 0.8f, 0, 0.6f, 0.8f};
    for (std::size_t i = 0; i < expected.size(); ++i) CHECK(std::abs(normals[i] - expected[i]) < 1e-6f);
    const Json& accessor = glb.json["accessors"][primitive["attributes"]["POSITION"].get<std::size_t>()];
    CHECK(is_near(accessor["min"][0], -0.1));
    CHECK(is_near(accessor["max"][1], 1.3));

    const Json& material = glb.json["materials"][0];
    CHECK(material["name"] == "leaf");
    CHECK(material["doubleSided"] == true);
    const Json& base = material["pbrMetallicRoughness"]["baseColorFactor"];
    CHECK(is_near(base[0], 0.5 * linear(200)));
    CHECK(is_near(base[1], linear(100)));
    CHECK(is_near(base[2], 0.25 * linear(50)));
    // Without the mirrored part, glTF's diffuse light is Lambert's.
    CHECK(material["extensions"]["KHR_materials_specular"]["specularFactor"] == 0);
}

TEST_CASE(
    "target/gltf: lights become KHR_lights_punctual's, in candela and lux, and the camera looks where the "
    "observer does") {
    const Glb glb = generated(folder_with_leaf(), k_scene);
    const Json& lights = glb.json["extensions"]["KHR_lights_punctual"]["lights"];
    REQUIRE(lights.size() == 2);
    CHECK(lights[0]["name"] == "lamp");
    CHECK(lights[0]["type"] == "point");
    CHECK(is_near(lights[0]["color"][1], linear(200)));
    CHECK(is_near(lights[0]["intensity"], 12 * std::numbers::pi));
    CHECK(lights[1]["type"] == "directional");
    CHECK(is_near(lights[1]["intensity"], 0.5 * std::numbers::pi));
    for (const Json& node : glb.json["nodes"]) {
        if (node["name"] == "lamp") CHECK(node["translation"] == Json{1.5, 3, 2});
        // Light travels along -z of its node: (1, -2, -2) / 3.
        if (node["name"] == "sun") {
            CHECK(is_near(node["matrix"][8], -1.0 / 3));
            CHECK(is_near(node["matrix"][9], 2.0 / 3));
            CHECK(is_near(node["matrix"][10], 2.0 / 3));
        }
        if (node["name"] == "observer") {
            const double length = std::sqrt(1 + 1.5 * 1.5 + 16);
            CHECK(is_near(node["matrix"][8], 1 / length));
            CHECK(is_near(node["matrix"][9], 1.5 / length));
            CHECK(is_near(node["matrix"][10], 4 / length));
            CHECK(is_near(node["matrix"][13], 2));
        }
    }
    const Json& camera = glb.json["cameras"][0]["perspective"];
    CHECK(is_near(camera["yfov"], 40 * std::numbers::pi / 180));
    CHECK(is_near(camera["aspectRatio"], 2));
}

TEST_CASE("target/gltf: candela import reads back the same scene, with the same picture") {
    const Folder folder;
    const std::string scene = k_view + R"([[object]]
name = "ball"
type = "sphere"
radius = 0.6
position = [-0.7, 0, 0]
color = [200, 100, 50]
material = {kd = 1, ka = 0}
[[object]]
name = "box"
type = "cube"
size = 0.8
rotation = [0, 30, 0]
position = [0.7, 0, 0]
color = [90, 160, 220]
material = {kd = 1, ka = 0}
)";
    generated(folder, scene);
    const std::string back = imported(folder);
    INFO(back);
    const auto has = [&](const std::string& line) {
        INFO(line);
        CHECK(holds(back, line + "\n"));
    };
    has("position     = [1.0, 2.0, 4.0]");
    has("fov          = 40.0");
    has("color     = [255, 200, 100]");
    has("intensity = \"37.6991 cd\"");
    has("position  = [1.5, 3.0, 2.0]");
    has("color     = [250, 240, 230]");
    has("intensity = \"1.5708 lx\"");
    has("direction = [0.33333, -0.66667, -0.66667]");
    CHECK(holds(back, "[200, 100, 50]"));
    CHECK(holds(back, "[90, 160, 220]"));
    CHECK(holds(back, "\"ball\""));

    succeeded(folder.run("render scene.toml -o a.png"));
    // Imported files with lights get a little ambient light, which the scene does not have.
    succeeded(folder.run(
        "render back.toml -o b.png --width 200 --height 100 --samples 1 --set light.sky.intensity=0"));
    expect(folder.run("diff a.png b.png --tolerance 1"), 0);
}

TEST_CASE("target/gltf: an unlit material is unlit, with no other extension") {
    const Json material =
        generated(folder_with_leaf(),
                  std::string(k_scene).replace(k_scene.find("material ="), std::string::npos,
                                               "reflection = \"unlit\"\n"),
                  {"--approximate"})
            .json["materials"][0];
    CHECK(material["extensions"] == Json{{"KHR_materials_unlit", Json::object()}});
    CHECK(is_near(material["pbrMetallicRoughness"]["baseColorFactor"][1], linear(100)));
}

TEST_CASE("target/gltf: metallic-roughness materials survive a round trip, with the same picture") {
    const Folder folder;
    const std::string scene = k_view + R"([[object]]
name = "ball"
type = "sphere"
radius = 0.6
position = [-0.7, 0, 0]
color = [200, 100, 50]
reflection = "metallic-roughness"
material = {ka = 0, metallic = 0.5, roughness = 0.4, sheen_color = [0.5, 0.2, 0.1], sheen_roughness = 0.5, iridescence = 0.5, ior = 1.75, clearcoat = 1, clearcoat_roughness = 0.3}
[[object]]
name = "box"
type = "cube"
size = 0.8
rotation = [0, 30, 0]
position = [0.7, 0, 0]
color = [90, 160, 220]
reflection = "specular-glossiness"
material = {ka = 0, specular_color = [0.3, 0.5, 0.1], glossiness = 0.4}
)";
    generated(folder, scene);
    const std::string back = imported(folder);
    INFO(back);
    CHECK(holds(back, "sheen_color           = [0.5, 0.2, 0.1]\n"));
    CHECK(holds(back, "clearcoat_roughness   = 0.3\n"));
    CHECK(holds(back, "specular_color = [0.3, 0.5, 0.1]\n"));
    succeeded(folder.run("render scene.toml -o a.png"));
    succeeded(folder.run(
        "render back.toml -o b.png --width 200 --height 100 --samples 1 --set light.sky.intensity=0"));
    expect(folder.run("diff a.png b.png --tolerance 2"), 0);
}

TEST_CASE("target/gltf: a plastic of ggx, as candela import made them, is metallic-roughness again") {
    const Folder folder = folder_with_leaf();
    // metallic 0.6 and roughness 0.5 of a base colour, as candela import converted them until 0.2.
    const double m = 0.6, dielectric = 0.04;
    const auto specular = [&](double byte) { return dielectric * (1 - m) + m * linear(byte); };
    const std::string scene = std::string(k_scene).replace(
        k_scene.find("material ="), std::string::npos,
        fmt::format("reflection = \"ggx\"\nmaterial = {{ka = 0, kd = {}, ks = [{}, {}, {}], "
                    "roughness = 0.25, ior = 100}}\n",
                    (1 - m) * (1 - dielectric), specular(200), specular(100), specular(50)));
    const Glb glb = generated(folder, scene, {"--approximate"});
    const Json& pbr = glb.json["materials"][0]["pbrMetallicRoughness"];
    CHECK(is_near(pbr["metallicFactor"], m));
    CHECK(is_near(pbr["roughnessFactor"], 0.5));
    CHECK(is_near(pbr["baseColorFactor"][0], linear(200)));
    CHECK_FALSE(glb.json["materials"][0].contains("extensions"));
}

TEST_CASE("target/gltf: a principled material becomes metallic-roughness of the same colour and numbers") {
    const Folder folder = folder_with_leaf();
    const auto material = [&](const std::string& values, const std::string& model = "disney") {
        const std::string scene =
            std::string(k_scene).replace(k_scene.find("material ="), std::string::npos,
                                         "reflection = \"" + model + "\"\nmaterial = { " + values + " }\n");
        return generated(folder, scene, {"--approximate"}).json["materials"][0];
    };
    const Json metal = material("metallic = 1, roughness = 0.3");
    CHECK(is_near(metal["pbrMetallicRoughness"]["metallicFactor"], 1));
    CHECK(is_near(metal["pbrMetallicRoughness"]["roughnessFactor"], 0.3));
    CHECK(is_near(metal["pbrMetallicRoughness"]["baseColorFactor"][2], linear(50)));
    CHECK_FALSE(metal.contains("extensions"));
    // Reflectance 0.08 at normal incidence is twice glTF's; the light that it takes is added to the base.
    const Json plastic = material("specular = 1, roughness = 0.6");
    CHECK(is_near(plastic["pbrMetallicRoughness"]["metallicFactor"], 0));
    CHECK(is_near(plastic["pbrMetallicRoughness"]["baseColorFactor"][1], linear(100) / 0.92));
    CHECK(is_near(plastic["extensions"]["KHR_materials_specular"]["specularColorFactor"][0], 2));
    const Json pbr =
        material("base_color = 0.5, base_weight = 0.5, base_metalness = 0.2, specular_roughness = 0.4",
                 "openpbr")["pbrMetallicRoughness"];
    CHECK(is_near(pbr["metallicFactor"], 0.2));
    CHECK(is_near(pbr["roughnessFactor"], 0.4));
    CHECK(is_near(pbr["baseColorFactor"][1], linear(100) / 4));
}

TEST_CASE("target/gltf: a metallic-roughness material is glTF's own, with the extensions that it needs") {
    const Folder folder = folder_with_leaf();
    const auto made = [&](const std::string& values) {
        return generated(folder, std::string(k_scene).replace(
                                     k_scene.find("material ="), std::string::npos,
                                     "reflection = \"metallic-roughness\"\nmaterial = { " + values + " }\n"));
    };
    const Json plain = made("metallic = 0.25, roughness = 0.75").json;
    CHECK(plain["extensionsUsed"] == Json::array({"KHR_lights_punctual"}));
    const Json& pbr = plain["materials"][0]["pbrMetallicRoughness"];
    CHECK(pbr["metallicFactor"] == 0.25);
    CHECK(pbr["roughnessFactor"] == 0.75);
    CHECK(is_near(pbr["baseColorFactor"][1], linear(100)));

    const Glb glb = made(
        "ior = 1.75, specular = 0.5, specular_color = [1, 2, 0.5], clearcoat = 0.5, clearcoat_roughness = "
        "0.25, sheen_color = [0, 0.5, 1], sheen_roughness = 0.5, anisotropy_strength = 0.5, "
        "anisotropy_rotation = 90, iridescence = 1, iridescence_ior = 1.5, iridescence_thickness = 500");
    const Json& extensions = glb.json["materials"][0]["extensions"];
    CHECK(glb.json["extensionsUsed"].size() == 7);  // with lights
    CHECK(extensions["KHR_materials_ior"] == Json{{"ior", 1.75}});
    CHECK(extensions["KHR_materials_specular"] ==
          Json{{"specularFactor", 0.5}, {"specularColorFactor", {1, 2, 0.5}}});
    CHECK(extensions["KHR_materials_clearcoat"] ==
          Json{{"clearcoatFactor", 0.5}, {"clearcoatRoughnessFactor", 0.25}});
    CHECK(extensions["KHR_materials_sheen"] ==
          Json{{"sheenColorFactor", {0, 0.5, 1}}, {"sheenRoughnessFactor", 0.5}});
    CHECK(is_near(extensions["KHR_materials_anisotropy"]["anisotropyRotation"], std::numbers::pi / 2));
    CHECK(extensions["KHR_materials_iridescence"] ==
          Json{{"iridescenceFactor", 1}, {"iridescenceIor", 1.5}, {"iridescenceThicknessMaximum", 500}});
    // A grain needs tangents: unit, perpendicular to the normals.
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    const Json& accessor = glb.json["accessors"][attributes["TANGENT"].get<std::size_t>()];
    CHECK(accessor["type"] == "VEC4");
    const std::size_t at = glb.json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"];
    const std::vector<float> normal = numbers<float>(glb, attributes["NORMAL"]);
    for (std::size_t i = 0; i < 3; ++i) {
        std::array<float, 4> t{};
        std::memcpy(t.data(), glb.buffer.data() + at + 16 * i, sizeof t);
        CHECK(std::abs(t[0] * normal[3 * i] + t[1] * normal[3 * i + 1] + t[2] * normal[3 * i + 2]) < 1e-6f);
        CHECK(std::abs(std::hypot(t[0], t[1], t[2]) - 1) < 1e-6f);
        CHECK(t[3] == 1);
    }
}

TEST_CASE("target/gltf: textures are embedded unchanged, with v from the top, and read back") {
    const Folder folder;
    folder.write("quad.obj",
                 "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 1 0.75\nvt 0 0.75\n"
                 "f 1/1 2/2 3/3 4/4\n");
    succeeded(folder.run("render -o picture.png --width 8 --height 8"));
    const std::string picture = folder.read("picture.png");
    const std::string scene = std::string(k_scene).replace(
        k_scene.find("file ="), std::string::npos,
        "file = \"quad.obj\"\ncolor = { texture = \"picture.png\", wrap = \"clamp\" }\n");
    const Glb glb = generated(folder, scene);
    const Json& image = glb.json["images"][0];
    CHECK(image["mimeType"] == "image/png");
    const Json& view = glb.json["bufferViews"][image["bufferView"].get<std::size_t>()];
    CHECK(glb.buffer.substr(view["byteOffset"], view["byteLength"]) == picture);
    CHECK(glb.json["samplers"][0]["wrapS"] == 33071);
    const Json& attributes = glb.json["meshes"][0]["primitives"][0]["attributes"];
    std::vector<float> uv = numbers<float>(glb, attributes["TEXCOORD_0"]);
    std::vector<float> v;
    for (std::size_t i = 1; i < uv.size(); i += 2) v.push_back(uv[i]);
    CHECK(*std::ranges::min_element(v) == 0.25f);
    CHECK(*std::ranges::max_element(v) == 1);
    const std::string back = imported(folder);
    CHECK(holds(back, "wrap = \"clamp\""));

    succeeded(folder.run("render -o picture.ppm --width 8 --height 8"));
    const Glb other =
        generated(folder, std::string(scene).replace(scene.find("picture.png"), 11, "picture.ppm"));
    const Json& made = other.json["bufferViews"][other.json["images"][0]["bufferView"].get<std::size_t>()];
    folder.write("made.png", other.buffer.substr(made["byteOffset"], made["byteLength"]));
    expect(folder.run("diff made.png picture.png"), 0);
}

TEST_CASE(
    "target/gltf: features that glTF lacks are refused by name, or reported once each with --approximate") {
    const Folder folder = folder_with_leaf();
    const std::string scene = k_scene + R"([[object]]
type = "sphere"
radius = 0.2
position = [-2, 0, 0]
reflection = "phong"
shading = "flat"
[[light]]
type = "ambient"
[[light]]
type = "spot"
position = [0, 4, 0]
direction = [0, -1, 0]
)";
    const CommandResult refused = generate(folder, scene);
    CHECK(refused.exit_code == 1);
    CHECK_FALSE(folder.has("scene.glb"));
    const CommandResult accepted = generate(folder, scene, {"--approximate"});
    CHECK(accepted.exit_code == 0);
    for (const std::string& name : {"reflection/phong", "light/ambient", "light/spot", "shading/flat"}) {
        INFO(name);
        CHECK(holds(refused.err, name));
        CHECK(count_of(accepted.err, name) == 1);
    }
}

TEST_CASE(
    "target/gltf: shadows are the showing program's, and only what differs by object or light is refused") {
    const Folder folder = folder_with_leaf();
    const std::string scene = std::string(k_scene) + "[shadows]\nenabled = true\n";
    expect(generate(folder, scene), 0);
    expect(generate(folder, scene, {"--set=object.leaf.casts_shadows=false"}), 1, {"every object casts"});
    expect(generate(folder, scene, {"--set=light.lamp.casts_shadows=false"}), 1, {"every light casts"});
}
