// candela import: texture maps of glTF files as textures of parameters, pixel by pixel against the
// specification's formulas.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/folder.h"
#include "support/gltf_square.h"
#include "support/ppm.h"
#include "support/text.h"

namespace {

using Json = nlohmann::json;
using Color = std::array<double, 4>;

constexpr int k_size = 64;

constexpr int k_repeat = 10497, k_clamp = 33071, k_mirror = 33648;
constexpr std::array k_repeats{k_repeat, k_repeat};

double linear(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }
double encoded(double c) { return c <= 0.0031308 ? 12.92 * c : 1.055 * std::pow(c, 1 / 2.4) - 0.055; }

/// A picture of 8 x 8 texels whose channels differ, soft enough for no level of mipmaps to be needed.
struct Picture {
    std::vector<RgbaPixel> texels;

    Picture() {
        for (int y = 0; y < 8; ++y)
            for (int x = 0; x < 8; ++x)
                texels.push_back({static_cast<std::uint8_t>(40 + 25 * x),
                                  static_cast<std::uint8_t>(190 + 8 * y),
                                  static_cast<std::uint8_t>(20 * (x + y) % 256 / 2 + 9 * y),
                                  static_cast<std::uint8_t>(60 + 20 * std::abs(x - y))});
    }
    std::string file() const { return png(8, 8, texels); }

    /// Which of eight texels is seen as number `i`, with glTF's number of a wrap.
    static int inside(int i, int wrap) {
        if (wrap == k_clamp) return std::clamp(i, 0, 7);
        const int repeated = (i % 16 + 16) % 16;
        return wrap == k_mirror && repeated > 7 ? 15 - repeated : repeated % 8;
    }

    /// Bilinear, at coordinates whose v points downwards.
    Color at(double u, double v, std::array<int, 2> wraps, bool is_srgb) const {
        const auto texel = [&](int x, int y, std::size_t channel) {
            const int place = 8 * inside(y, wraps[1]) + inside(x, wraps[0]);
            const double c = texels[static_cast<std::size_t>(place)][channel] / 255.0;
            return is_srgb ? linear(c) : c;
        };
        const double x = 8 * u - 0.5, y = 8 * v - 0.5;
        const int left = static_cast<int>(std::floor(x)), top = static_cast<int>(std::floor(y));
        const double right = x - left, below = y - top;
        Color color{};
        for (std::size_t c = 0; c < 4; ++c)
            color[c] = (1 - below) * ((1 - right) * texel(left, top, c) + right * texel(left + 1, top, c)) +
                       below * ((1 - right) * texel(left, top + 1, c) + right * texel(left + 1, top + 1, c));
        return color;
    }
};

/// The light of a white surface seen along its normal, which is lit from there by 0.5, and from everywhere by
/// 0.1.
struct Surface {
    double metallic = 1, roughness = 1, specular = 1, coat = 0, coat_roughness = 0;
    Color tint{1, 1, 1};

    /// glTF 2.0, appendix B, with KHR_materials_specular and clearcoat; pi times it, as lights of Candela
    /// are. Of the three channels, `c`.
    double light(std::size_t c) const {
        const auto facets = [](double rough) { return 1 / (4 * std::pow(rough, 4)); };
        const auto reflectance = [&](std::size_t k) { return specular * std::min(0.04 * tint[k], 1.0); };
        const double most = std::max({reflectance(0), reflectance(1), reflectance(2)});
        const double coated = 0.04 * coat;
        const double base =
            (1 - metallic) * (1 - most + reflectance(c) * facets(roughness)) + metallic * facets(roughness);
        return 0.5 * ((1 - coated) * base + (coated > 0 ? coated * facets(coat_roughness) : 0));
    }
};

/// The folder of an imported file, with its scene.
struct Imported {
    Folder folder;
    CommandResult result;
    std::string scene;

    std::string material() const { return scene.substr(scene.rfind("[object.material]")); }
};

Imported import(GltfSquare& file) {
    Imported imported;
    imported.folder.write("a.glb", file.glb());
    imported.result = succeeded(imported.folder.run("import a.glb"));
    imported.scene = imported.folder.read("a.toml");
    const CommandResult checked = expect(imported.folder.run("check a.toml"), 0);
    CHECK_FALSE(holds(checked.err, "warning"));
    return imported;
}

/// The scene's object under lights of the test, seen along its normal; u and v of the middle of its pixels
/// are (0.5 + x) / 64 and (0.5 + y) / 64.
std::string staged(const std::string& scene) {
    const std::size_t model = scene.find("[reflection]");
    return fmt::format(
        "version = 1\nobserver = {{ position = [0, 0, 4], look_at = [0, 0, 0], projection = "
        "\"orthographic\", "
        "height = 2 }}\nimage = {{ width = {0}, height = {0}, samples = 1 }}\nshading = {{ model = \"phong\" "
        "}}\n[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\nintensity = 0.5\n[[light]]\ntype "
        "= \"ambient\"\nintensity = 0.1\n\n{1}\n{2}",
        k_size, scene.substr(model, scene.find("\n\n", model) - model),
        scene.substr(scene.find("[[object]]")));
}

/// `expected`: at coordinates whose v points downwards, in each channel.
void require_picture(const Imported& imported,
                     const std::function<std::array<double, 3>(double u, double v)>& expected) {
    imported.folder.write("staged.toml", staged(imported.scene));
    expect(imported.folder.run("render staged.toml -o a.ppm"), 0);
    const Ppm picture = read_ppm(imported.folder / "a.ppm");
    INFO(imported.scene);
    int wrong = 0;
    for (int y = 0; y < k_size; ++y)
        for (int x = 0; x < k_size; ++x) {
            const auto light = expected((x + 0.5) / k_size, (y + 0.5) / k_size);
            for (std::size_t c = 0; c < 3; ++c) {
                REQUIRE(light[c] < 1);
                wrong += std::abs(255 * encoded(light[c]) - picture.at(x, y)[c]) > 1;
            }
        }
    REQUIRE(wrong == 0);
}

std::array<double, 3> lit(const Surface& surface, double ambient) {
    return {surface.light(0) + ambient, surface.light(1) + ambient, surface.light(2) + ambient};
}

}  // namespace

TEST_CASE("a map of metalness and roughness gives each point its own, wherever its transform puts it") {
    const Picture picture;
    struct Placing {
        double scale_u, scale_v, rotation, offset_u, offset_v;
        std::array<int, 2> wraps = k_repeats;
    };
    for (const Placing& p :
         {Placing{1, 1, 0, 0, 0}, Placing{0.5, 2, 0.4, 0.3, -0.2}, Placing{-1, 0.75, -2, 0.1, 0.6},
          Placing{1.5, 1.25, 0.2, -0.2, 0.1, {k_clamp, k_clamp}},
          Placing{1.5, 1.25, 0.2, -0.2, 0.1, {k_mirror, k_repeat}},
          Placing{1.25, 1.5, -0.3, 0.4, -0.7, {k_clamp, k_mirror}}}) {
        GltfSquare file;
        file.pbr() = {{"metallicFactor", 0.75}, {"roughnessFactor", 0.9}};
        Json map = file.texture(picture.file());
        map["extensions"]["KHR_texture_transform"] = {{"scale", {p.scale_u, p.scale_v}},
                                                      {"rotation", p.rotation},
                                                      {"offset", {p.offset_u, p.offset_v}}};
        file.json["samplers"] = {{{"wrapS", p.wraps[0]}, {"wrapT", p.wraps[1]}}};
        file.json["textures"][0]["sampler"] = 0;
        file.pbr()["metallicRoughnessTexture"] = map;
        const Imported imported = import(file);
        CHECK_FALSE(holds(imported.scene, "# Note"));
        require_picture(imported, [&](double u, double v) {
            const double c = std::cos(p.rotation), s = std::sin(p.rotation);
            const Color texel =
                picture.at(c * p.scale_u * u + s * p.scale_v * v + p.offset_u,
                           -s * p.scale_u * u + c * p.scale_v * v + p.offset_v, p.wraps, false);
            const double metallic = 0.75 * texel[2];
            // Half of the surroundings of a metal, and what a dielectric does not mirror.
            return lit({.metallic = metallic, .roughness = 0.9 * texel[1]},
                       0.1 * (0.96 * (1 - metallic) + 0.5 * metallic));
        });
    }
}

TEST_CASE("maps have the set of texture coordinates that the file says, each of two") {
    const Picture picture;
    GltfSquare file;
    // The second ones are half of the first, turned by a quarter: (v / 2, 1 - u / 2).
    file.primitive()["attributes"]["TEXCOORD_1"] = file.floats("VEC2", {0.5, 1, 0.5, 0.5, 0, 0.5, 0, 1});
    file.pbr() = {{"metallicFactor", 0.75}, {"roughnessFactor", 0.9}};
    Json map = file.texture(picture.file());
    map["texCoord"] = 1;
    file.pbr()["metallicRoughnessTexture"] = map;
    file.pbr()["baseColorTexture"] = file.texture(png(1, 1, {{255, 255, 255, 255}}));
    for (const bool is_transform : {false, true}) {
        if (is_transform) {
            // An extension's set takes the place of the texture's own.
            file.pbr()["metallicRoughnessTexture"]["texCoord"] = 0;
            file.pbr()["metallicRoughnessTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
        }
        const Imported imported = import(file);
        CHECK_FALSE(holds(imported.scene, "# Note"));
        require_picture(imported, [&](double u, double v) {
            const Color texel = picture.at(v / 2, 1 - u / 2, k_repeats, false);
            const double metallic = 0.75 * texel[2];
            return lit({.metallic = metallic, .roughness = 0.9 * texel[1]},
                       0.1 * (0.96 * (1 - metallic) + 0.5 * metallic));
        });
    }
}

TEST_CASE("texture coordinates and wraps come back as they went in") {
    GltfSquare file;
    file.primitive()["attributes"]["TEXCOORD_1"] = file.floats("VEC2", {0.5, 1, 0.5, 0.5, 0, 0.5, 0, 1});
    file.pbr()["baseColorTexture"] = file.texture(Picture().file());
    file.pbr()["baseColorTexture"]["texCoord"] = 1;
    file.json["samplers"] = {{{"wrapS", k_mirror}, {"wrapT", k_clamp}}};
    file.json["textures"][0]["sampler"] = 0;
    const Imported imported = import(file);
    CHECK(holds(imported.scene, "wrap = \"mirror\", wrap_v = \"clamp\", uv = 1 }"));
    succeeded(imported.folder.run("generate a.toml --target gltf -o made --approximate --quiet"));
    succeeded(imported.folder.run("import made/scene.glb -o again.toml"));
    CHECK(holds(imported.folder.read("again.toml"), "wrap = \"mirror\", wrap_v = \"clamp\", uv = 1 }"));
}

TEST_CASE("a map of the base colour is placed by its transform, and multiplied by the factor") {
    const Picture picture;
    const std::array<double, 4> factor{0.9, 0.7, 0.5, 1};
    const double rotation = 0.4;
    GltfSquare file;
    file.pbr() = {{"metallicFactor", 0},
                  {"baseColorFactor", factor},
                  {"baseColorTexture", file.texture(picture.file())}};
    file.pbr()["baseColorTexture"]["extensions"]["KHR_texture_transform"] = {
        {"scale", {0.5, 1.5}}, {"rotation", rotation}, {"offset", {0.3, -0.2}}};
    // Without the mirrored part, only a matt surface is left.
    file.material()["extensions"]["KHR_materials_specular"]["specularFactor"] = 0;
    const Imported imported = import(file);
    CHECK_FALSE(holds(imported.scene, "# Note"));
    require_picture(imported, [&](double u, double v) {
        const double c = std::cos(rotation), s = std::sin(rotation);
        const Color texel =
            picture.at(c * 0.5 * u + s * 1.5 * v + 0.3, -s * 0.5 * u + c * 1.5 * v - 0.2, k_repeats, true);
        return std::array<double, 3>{0.6 * factor[0] * texel[0], 0.6 * factor[1] * texel[1],
                                     0.6 * factor[2] * texel[2]};
    });
}

TEST_CASE("a clear coat whose normals are not its surface's is noted") {
    const auto said = [](bool has_map, bool has_coat_map, double scale, double factor = 1) {
        const Folder folder;
        GltfSquare file;
        const auto map = file.texture(png(2, 1, {{128, 128, 255, 255}, {200, 128, 220, 255}}));
        auto scaled = map;
        if (scale != 1) scaled["scale"] = scale;
        if (has_map) file.material()["normalTexture"] = map;
        file.material()["extensions"]["KHR_materials_clearcoat"] = {{"clearcoatFactor", factor}};
        if (has_coat_map)
            file.material()["extensions"]["KHR_materials_clearcoat"]["clearcoatNormalTexture"] = scaled;
        folder.write("a.glb", file.glb());
        return succeeded(folder.run("import a.glb -o scene.toml")).err;
    };
    const char* const left_out =
        "the normal map of a clear coat is left out, which has its surface's normals";
    const char* const smooth = "a clear coat that is smooth in the file has its surface's normal map";
    CHECK(holds(said(false, true, 1), left_out));
    CHECK(holds(said(true, true, 0.5), left_out));
    CHECK(holds(said(true, false, 1), smooth));
    CHECK_FALSE(holds(said(true, true, 1), "coat"));
    CHECK_FALSE(holds(said(false, false, 1), "coat"));
    CHECK_FALSE(holds(said(false, true, 1, 0), "coat"));
}

TEST_CASE("maps of KHR_materials_specular and clearcoat are read from their channels") {
    const Picture picture;
    GltfSquare file;
    const Json map = file.texture(picture.file());
    file.pbr() = {{"metallicFactor", 0}, {"roughnessFactor", 0.8}};
    file.material()["extensions"] = {{"KHR_materials_specular",
                                      {{"specularFactor", 0.8},
                                       {"specularTexture", map},
                                       {"specularColorFactor", {8, 2, 1}},
                                       {"specularColorTexture", map}}},
                                     {"KHR_materials_clearcoat",
                                      {{"clearcoatFactor", 0.9},
                                       {"clearcoatTexture", map},
                                       {"clearcoatRoughnessFactor", 0.7},
                                       {"clearcoatRoughnessTexture", map}}}};
    const Imported imported = import(file);
    CHECK_FALSE(holds(imported.scene, "# Note"));
    require_picture(imported, [&](double u, double v) {
        const Color texel = picture.at(u, v, k_repeats, false), color = picture.at(u, v, k_repeats, true);
        return lit({.metallic = 0,
                    .roughness = 0.8,
                    .specular = 0.8 * texel[3],
                    .coat = 0.9 * texel[0],
                    .coat_roughness = 0.7 * texel[1],
                    .tint = {8 * color[0], 2 * color[1], color[2]}},
                   // 0.8 of the largest channel of the factor's reflectance is mirrored.
                   0.1 * (1 - 0.8 * 0.04 * 8));
    });
}

TEST_CASE("maps of sheen, anisotropy and iridescence become textures of their parameters") {
    const Picture picture;
    GltfSquare file;
    const Json map = file.texture(picture.file());
    file.material()["extensions"] = {
        {"KHR_materials_sheen",
         {{"sheenColorFactor", {0.5, 0.5, 1}},
          {"sheenColorTexture", map},
          {"sheenRoughnessFactor", 0.7},
          {"sheenRoughnessTexture", map}}},
        {"KHR_materials_anisotropy", {{"anisotropyStrength", 0.6}, {"anisotropyTexture", map}}},
        {"KHR_materials_iridescence",
         {{"iridescenceFactor", 1},
          {"iridescenceTexture", map},
          {"iridescenceThicknessMinimum", 200},
          {"iridescenceThicknessMaximum", 600},
          {"iridescenceThicknessTexture", map}}}};
    const Imported imported = import(file);
    const std::string material = imported.material();
    INFO(material);
    for (const char* const line :
         {"sheen_color           = { texture = \"a_textures/texture0.png\", scale = [0.5, 0.5, 1.0] }\n",
          "sheen_roughness       = { texture = \"a_textures/texture0.png\", channel = \"a\", scale = 0.7 }\n",
          "anisotropy_strength   = { texture = \"a_textures/texture0.png\", channel = \"b\", scale = 0.6 }\n",
          "iridescence           = { texture = \"a_textures/texture0.png\", channel = \"r\" }\n",
          "iridescence_thickness = { texture = \"a_textures/texture0.png\", channel = \"g\", scale = 400.0, "
          "offset = 200.0 }\n"})
        CHECK(holds(material, line));
    CHECK(holds(imported.result.err, "a texture of the direction of anisotropy becomes its mean"));
}

TEST_CASE("maps of specular-glossiness give each point its reflectance and gloss") {
    const Picture picture;
    GltfSquare file;
    file.material()["extensions"]["KHR_materials_pbrSpecularGlossiness"] = {
        {"specularFactor", {0.5, 0.25, 0.5}},
        {"glossinessFactor", 0.4},
        {"specularGlossinessTexture", file.texture(picture.file())}};
    const Imported imported = import(file);
    CHECK_FALSE(holds(imported.scene, "# Note"));
    const std::string material = imported.material();
    const double ka = std::stod(material.substr(material.find("= ") + 2));
    require_picture(imported, [&](double u, double v) {
        const double alpha = std::pow(1 - 0.4 * picture.at(u, v, k_repeats, false)[3], 2);
        Color color = picture.at(u, v, k_repeats, true);
        color = {0.5 * color[0], 0.25 * color[1], 0.5 * color[2]};
        const double diffuse = 1 - std::max({color[0], color[1], color[2]});
        const auto channel = [&](double mirrored) {
            return 0.1 * ka + 0.5 * (diffuse + mirrored / (4 * alpha * alpha));
        };
        return std::array<double, 3>{channel(color[0]), channel(color[1]), channel(color[2])};
    });
}

TEST_CASE("a normal map tilts the normals of a matt surface, as steeply as its scale says") {
    Picture picture;
    for (std::size_t i = 0; i < picture.texels.size(); ++i) {
        const auto x = static_cast<int>(i % 8), y = static_cast<int>(i / 8);
        picture.texels[i] = {static_cast<std::uint8_t>(90 + 10 * x), static_cast<std::uint8_t>(170 - 9 * y),
                             static_cast<std::uint8_t>(200 + 3 * x), 255};
    }
    GltfSquare file;
    file.pbr() = {{"metallicFactor", 0}, {"roughnessFactor", 1}};
    file.material()["extensions"]["KHR_materials_specular"] = {{"specularFactor", 0}};
    Json map = file.texture(picture.file());
    map["scale"] = 1.5;
    file.material()["normalTexture"] = map;
    const Imported imported = import(file);
    CHECK_FALSE(holds(imported.scene, "# Note"));
    require_picture(imported, [&](double u, double v) {
        const Color texel = picture.at(u, v, k_repeats, false);
        const double x = 1.5 * (2 * texel[0] - 1), y = 1.5 * (2 * texel[1] - 1), z = 2 * texel[2] - 1;
        const double light = 0.1 + 0.5 * z / std::sqrt(x * x + y * y + z * z);
        return std::array{light, light, light};
    });
}

TEST_CASE("a map whose channel is the same everywhere becomes a number") {
    GltfSquare file, numbers;
    file.pbr() = {{"metallicRoughnessTexture",
                   file.texture(png(2, 1, {RgbaPixel{9, 51, 255, 255}, RgbaPixel{200, 51, 255, 255}}))}};
    numbers.pbr() = {{"roughnessFactor", 0.2}};
    const Imported imported = import(file);
    CHECK(imported.material() == import(numbers).material());
    CHECK(holds(imported.result.out + imported.result.err, "0 textures"));
}

TEST_CASE("a map that is missing, broken or has other coordinates leaves the factor alone, with a warning") {
    const auto leaves = [](GltfSquare& file, const char* warning) {
        file.pbr()["metallicFactor"] = 0;
        file.pbr()["roughnessFactor"] = 0.25;
        const Imported imported = import(file);
        CHECK(holds(imported.material(), "roughness = 0.25\n"));
        CHECK(holds(imported.result.err, warning));
    };
    GltfSquare missing;
    missing.pbr()["metallicRoughnessTexture"]["index"] = 7;
    leaves(missing, "the picture of a texture of material 0 is missing");
    GltfSquare broken;
    broken.pbr()["metallicRoughnessTexture"] = broken.texture(Picture().file().substr(0, 90));
    leaves(broken, "a texture of material 0 is left out: ");
    GltfSquare other;
    other.pbr()["metallicRoughnessTexture"] = other.texture(Picture().file());
    other.pbr()["metallicRoughnessTexture"]["extensions"]["KHR_texture_transform"]["texCoord"] = 1;
    leaves(other, "a texture on a further set of texture coordinates is left out");
    GltfSquare hostile;
    hostile.pbr()["metallicRoughnessTexture"] = hostile.texture(Picture().file());
    hostile.pbr()["metallicRoughnessTexture"]["extensions"]["KHR_texture_transform"] = {
        {"scale", {1e300, -1e300}}, {"rotation", 1e300}, {"offset", {"x", Json()}}};
    import(hostile);
}

TEST_CASE("without texture coordinates, a map becomes its mean") {
    GltfSquare file;
    file.primitive()["attributes"].erase("TEXCOORD_0");
    file.pbr() = {{"metallicFactor", 0},
                  {"metallicRoughnessTexture",
                   file.texture(png(2, 1, {RgbaPixel{0, 51, 0, 255}, RgbaPixel{0, 153, 0, 255}}))}};
    const Imported imported = import(file);
    CHECK(holds(imported.material(), "roughness = 0.4\n"));
    CHECK(holds(imported.result.err, "its textures are left out; it has no texture coordinates"));
}

TEST_CASE("maps survive a round trip from glTF to glTF, with the same picture") {
    const Picture picture;
    GltfSquare file;
    Json map = file.texture(picture.file());
    const Json other = map;
    map["extensions"]["KHR_texture_transform"] = {
        {"scale", {0.5, 2}}, {"rotation", 0.4}, {"offset", {0.3, -0.2}}};
    file.pbr() = {{"roughnessFactor", 0.9}, {"metallicRoughnessTexture", map}};
    file.material()["normalTexture"] = map;
    file.material()["normalTexture"]["scale"] = 0.25;
    file.material()["extensions"] = {
        {"KHR_materials_specular", {{"specularTexture", other}, {"specularColorTexture", other}}},
        {"KHR_materials_sheen",
         {{"sheenColorFactor", {0.5, 0.5, 1}},
          {"sheenColorTexture", other},
          {"sheenRoughnessFactor", 1},
          {"sheenRoughnessTexture", other}}},
        {"KHR_materials_iridescence", {{"iridescenceFactor", 1}, {"iridescenceThicknessTexture", other}}}};
    const Imported imported = import(file);
    const Folder& folder = imported.folder;
    folder.write("first.toml", staged(imported.scene));
    succeeded(folder.run("render first.toml -o first.ppm"));
    succeeded(folder.run("generate first.toml --target gltf -o made --approximate --quiet"));
    succeeded(folder.run("import made/scene.glb -o second.toml"));
    folder.write("second.toml", staged(folder.read("second.toml")));
    succeeded(folder.run("render second.toml -o second.ppm"));
    CHECK(largest_difference(read_ppm(folder / "first.ppm"), read_ppm(folder / "second.ppm")) <= 1);
}
