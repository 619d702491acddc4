// Numbers of the vertices, and pictures placed by second texture coordinates, in generated programs.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/expect.h"
#include "support/gltf_file.h"
#include "support/text.h"

namespace fs = std::filesystem;

namespace {

/// A bulging square of 6 x 6 vertices with all that a file of glTF may say of them.
std::string bulge() {
    constexpr int k_side = 6;
    std::vector<float> position, normal, uv, second_uv, wear, color;
    std::vector<std::uint32_t> indices;
    const auto add = [](std::vector<float>& to, std::initializer_list<double> numbers) {
        for (const double number : numbers) to.push_back(static_cast<float>(number));
    };
    for (int row = 0; row < k_side; ++row) {
        for (int column = 0; column < k_side; ++column) {
            const double s = column / (k_side - 1.0), t = row / (k_side - 1.0), x = s - 0.5, y = t - 0.5;
            const double length = std::sqrt(1 + x * x + y * y);
            add(position, {1.1 * x, 1.1 * y, 0.3 - 0.5 * (x * x + y * y)});
            add(normal, {x / length, y / length, 1 / length});
            add(uv, {s, 1 - t});
            add(second_uv, {0.3 + 1.9 * t + 0.2 * s, 1.4 * s - 0.4 * t});
            add(wear, {0.5 + 0.5 * std::sin(5 * x + 3 * y)});
            add(color, {1 - 0.3 * s, 0.7 + 0.3 * t, 0.9, 0.3 + 0.6 * s});
            if (row + 1 == k_side || column + 1 == k_side) continue;
            const auto corner = static_cast<std::uint32_t>(row * k_side + column);
            for (const std::uint32_t offset : {0u, 1u, 7u, 0u, 7u, 6u}) indices.push_back(corner + offset);
        }
    }
    GltfFile file(GltfFile::Json::parse(R"({"scenes": [{"nodes": [0]}], "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {}}]}]})"));
    auto& primitive = file.json["meshes"][0]["primitives"][0];
    primitive["attributes"] = {
        {"POSITION", file.floats("VEC3", position)}, {"NORMAL", file.floats("VEC3", normal)},
        {"TEXCOORD_0", file.floats("VEC2", uv)},     {"TEXCOORD_1", file.floats("VEC2", second_uv)},
        {"_WEAR", file.floats("SCALAR", wear)},      {"COLOR_0", file.floats("VEC4", color)}};
    primitive["indices"] = file.integers(indices);
    return file.glb();
}

/// Values change by a few steps from texel to texel.
std::string soft_picture() {
    std::string text = "P6\n16 16\n255\n";
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (const int value :
                 {90 + 8 * std::abs(x - 8), 200 - 9 * std::abs(y - 8), 110 + 5 * std::abs(x - y)})
                text += static_cast<char>(value);
    return text;
}

/// One for each rate at which light is evaluated.
std::string objects(const std::string& object, const std::string& material, double z = 0) {
    std::string text;
    for (const char* const shading : {"phong", "gouraud", "flat"})
        text += fmt::format(
            "[[object]]\nname = \"{0} at {4}\"\ntype = \"mesh\"\nfile = \"bulge.glb\"\nposition = [{1}, 0, "
            "{4}]\n"
            "rotation = [-20, 25, 0]\nshading = \"{0}\"\nreflection = \"phong\"\n{2}[object.material]\n{3}",
            shading,
            shading[0] == 'p'   ? -1.3
            : shading[0] == 'g' ? 0
                                : 1.3,
            object, material, z);
    return text;
}

fs::path scene(const fs::path& folder, const std::string& of) {
    write_file(folder / "bulge.glb", bulge());
    write_file(folder / "soft.ppm", soft_picture());
    return write_file(
        folder / "scene.toml",
        "version = 1\n[observer]\nposition = [0, 0.3, 4]\nlook_at = [0, 0, 0]\nfov = 40\n[image]\nwidth = "
        "180\nheight = 90\n[constraints]\noverlap = \"allow\"\n[[light]]\ntype = \"point\"\nposition = [-2, "
        "4, "
        "3]\nintensity = 20\n[[light]]\ntype = \"ambient\"\n" +
            of);
}

void verify(const fs::path& scene, const char* target) {
    const CommandResult result = run_candela({"verify", scene.string(), "--target", target});
    INFO(target << '\n' << result.out << result.err);
    CHECK(holds(succeeded(result).out, "match"));
}

constexpr const char* k_attributes =
    "kd = { attribute = \"_WEAR\", channel = \"r\", scale = [0.6, 0.5, 0.4], offset = 0.3 }\n"
    "shininess = { attribute = \"color\", channel = \"a\", scale = 20, offset = 2 }\n"
    "emission = { attribute = \"color\", scale = 0.1 }\n"
    "occlusion = { attribute = \"color\", channel = \"g\" }\n";

constexpr const char* k_second_picture =
    "{ texture = \"soft.ppm\", channel = \"g\", uv = 1, transform = { scale = [1.4, 1.2] } }";

/// Another one, behind the others; its material follows.
constexpr const char* k_behind =
    "[[object]]\nname = \"behind\"\ntype = \"mesh\"\nfile = \"bulge.glb\"\nposition = [-0.4, -0.2, "
    "-0.6]\nscale = [3, 1.6, 1]\nshading = \"flat\"\nreflection = \"phong\"\ncolor = [250, 90, "
    "60]\n[object.material]\n";

}  // namespace

TEST_CASE("verify: programs have the numbers of the vertices") {
    const fs::path folder = scratch_directory();
    const fs::path worn = scene(folder, objects("color = [250, 240, 230]\n", k_attributes));
    for (const char* const target : {"cpp", "opengl", "webgl", "three"}) verify(worn, target);
}

TEST_CASE(
    "verify: programs place pictures by the second texture coordinates, and continue them in a mirror") {
    const fs::path folder = scratch_directory();
    const fs::path placed = scene(
        folder,
        objects(
            "color = { texture = \"soft.ppm\", uv = 1, wrap = \"mirror\", transform = { scale = [1.4, 1.2], "
            "rotation = 20 } }\nbump_map = { texture = \"soft.ppm\", height = 0.05, uv = 1 }\n",
            "kd = { texture = \"soft.ppm\", wrap = \"clamp\", wrap_v = \"mirror\", transform = { scale = [2, "
            "1.7], offset = [-0.4, -0.3] } }\n"
            "shininess = { texture = \"soft.ppm\", channel = \"b\", uv = 1, wrap_v = \"clamp\", scale = 40, "
            "offset = 4 }\nocclusion = { attribute = \"color\", channel = \"g\" }\n") +
            // Without a picture, next to those.
            "[[object]]\ntype = \"mesh\"\nfile = \"bulge.glb\"\nposition = [0, -1.1, 0.3]\nshading = "
            "\"phong\"\n"
            "reflection = \"phong\"\n[object.material]\n" +
            k_attributes);
    for (const char* const target : {"cpp", "opengl", "webgl", "three"}) verify(placed, target);
}

TEST_CASE(
    "verify: programs have an opacity that the vertices give, or a picture by their second coordinates") {
    const fs::path folder = scratch_directory();
    const fs::path covering = scene(
        folder,
        objects("", "opacity = { attribute = \"color\", channel = \"a\", scale = 0.8, offset = 0.1 }\n") +
            k_behind + "opacity = " + k_second_picture + "\n");
    for (const char* const target : {"cpp", "opengl", "webgl", "three"}) verify(covering, target);
}

TEST_CASE("verify: cut-outs by numbers of the vertices have the same edge at every rate", "[whole]") {
    const fs::path folder = scratch_directory();
    const fs::path cut = scene(
        folder,
        objects("", "opacity = { attribute = \"_WEAR\" }\nopacity_cutoff = 0.55\n") +
            // A picture of its material is placed by the first coordinates, one of its opacity by the second.
            objects("",
                    std::string("kd = { texture = \"soft.ppm\" }\nopacity = ") + k_second_picture +
                        "\nopacity_cutoff = 0.5\n",
                    -1));
    for (const char* const target : {"cpp", "opengl", "webgl", "three"}) verify(cut, target);
}

TEST_CASE("verify: shadows have an opacity that the vertices give, or a picture by their second coordinates",
          "[whole]") {
    const fs::path folder = scratch_directory();
    const std::string of_vertices =
        "opacity = { attribute = \"color\", channel = \"a\", scale = 0.8, offset = 0.1 }\n";
    const std::string wall =
        "[shadows]\nenabled = true\n[[object]]\ntype = \"cube\"\nsize = 3\nposition = [0, 0, -2.2]\nshading "
        "= "
        "\"phong\"\nreflection = \"lambert\"\n";
    SECTION("of both, next to a picture by the first coordinates") {
        const fs::path all = scene(
            folder, wall + objects("", of_vertices) + k_behind + "opacity = " + k_second_picture + "\n" +
                        "[[object]]\ntype = \"sphere\"\nradius = 0.3\nposition = [0, 0.9, 0.5]\nshading = "
                        "\"gouraud\"\nreflection = \"lambert\"\n[object.material]\nopacity = { texture = "
                        "\"soft.ppm\" }\n");
        for (const char* const target : {"cpp", "opengl", "webgl", "three"}) verify(all, target);
    }
    SECTION("and read no picture if there is none") {
        const fs::path plain = scene(folder, wall + objects("", of_vertices + "opacity_cutoff = 0.5\n"));
        for (const char* const target : {"opengl", "webgl"}) verify(plain, target);
        const fs::path program = folder / "program";
        succeeded(run_candela({"generate", plain.string(), "--target", "opengl", "-o", program.string()}));
        const std::string text = read_file(program / "scene.cpp");
        CHECK(holds(text, "textured_blocked_part"));
        for (const char* const word : {"shadow_picture_texel", "read_ppm"}) CHECK_FALSE(holds(text, word));
    }
}

TEST_CASE("verify: programs have an opacity that is a product of pictures and of numbers of the vertices") {
    const fs::path folder = scratch_directory();
    const std::string every_rate =
        objects("",
                "opacity = [{ attribute = \"color\", channel = \"a\" }, { texture = "
                "\"soft.ppm\", channel = \"g\" }]\nkd = { texture = \"soft.ppm\" }\n");
    for (const char* const target : {"cpp", "opengl", "webgl"}) verify(scene(folder, every_rate), target);
    const fs::path in_shadow =
        scene(folder, "[shadows]\nenabled = true\n" +
                          objects("",
                                  "opacity = [{ texture = \"soft.ppm\" }, { texture = \"soft.ppm\", channel "
                                  "= \"g\" }]\n"));
    expect(
        run_candela({"generate", in_shadow.string(), "--target", "webgl", "-o", (folder / "page").string()}),
        1, {"the opacity of object phong at 0, which is a product", "--no-shadows"});
}

TEST_CASE("generate: programs of scenes without numbers of the vertices do not mention them") {
    for (const char* const target : {"cpp", "opengl"}) {
        const fs::path folder = scratch_directory(), program = folder / target;
        const fs::path plain = scene(folder, objects("color = { texture = \"soft.ppm\" }\n", ""));
        succeeded(run_candela({"generate", plain.string(), "--target", target, "-o", program.string()}));
        for (const char* const word : {"channels", "second_uv"})
            CHECK_FALSE(holds(read_file(program / "scene.cpp"), word));
    }
}
