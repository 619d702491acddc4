// The textures of generated programs: how precisely they preserve pictures, and in which files.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "candela/target/textures.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/text.h"

namespace fs = std::filesystem;
using candela::ColorEncoding;
using candela::target::TexturePixels;

namespace {

/// IEC 61966-2-1, 65535 for an intensity of 1, in floats as the renderer decodes pictures.
std::uint16_t intensity_of(int byte) {
    const double c = byte / 255.0;
    const auto color = static_cast<float>(byte);
    const auto intensity =
        std::lround(65535 * candela::decoded({color, color, color}, ColorEncoding::srgb).r);
    CHECK(std::abs(static_cast<double>(intensity) -
                   65535 * (c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4))) < 0.51);
    return static_cast<std::uint16_t>(intensity);
}

/// A row of grey texels.
TexturePixels pixels_of(const std::vector<std::uint16_t>& row, ColorEncoding encoding) {
    std::vector<std::uint16_t> texels;
    for (const std::uint16_t value : row) texels.insert(texels.end(), {value, value, value});
    const std::vector<candela::ExportedTextureLevel> levels = {
        {.width = static_cast<int>(row.size()), .height = 1, .texels = texels}};
    return candela::target::pixels_of({.file = "/pictures/row.png", .levels = levels}, encoding);
}

constexpr const char* k_square =
    "mtllib square.mtl\nv -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 2 0\nvt 2 2\nvt 0 2\nvn 0 0 1\n"
    "usemtl tiles\nf 1/1/1 2/2/1 3/3/1 4/4/1\n";

/// 128 x 2 pixels, `bytes` per channel; every byte value occurs.
std::string small_ppm(int bytes) {
    std::string file = fmt::format("P6\n128 2\n{}\n", bytes == 1 ? 255 : 65535);
    for (int i = 0; i < 768 * bytes; ++i) file += static_cast<char>(40 + 11 * i);
    return file;
}

std::string scene_with(const std::string& images) {
    std::string objects;
    int x = 0;
    for (const char image : images)
        objects += fmt::format(
            "[[object]]\ntype = \"mesh\"\nfile = \"square.obj\"\nappearance_imported = true\n"
            "position = [{}, 0, 0]\ncolor = {{ texture = \"{}.ppm\" }}\n",
            3 * x++, image);
    return "version = 1\n[observer]\nposition = [0, 0, 6]\nlook_at = [0, 0, 0]\n[room]\nwidth = 50\nheight = "
           "50\ndepth = 50\n[image]\nwidth = 48\nheight "
           "= 32\n"
           "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"lambert\"\n[[light]]\ntype = "
           "\"ambient\"\n" +
           objects;
}

}  // namespace

TEST_CASE("textures of programs: all 8-bit colours are preserved") {
    std::vector<std::uint16_t> encoded, plain;
    for (int byte = 0; byte < 256; ++byte) {
        encoded.push_back(intensity_of(byte));
        plain.push_back(static_cast<std::uint16_t>(257 * byte));
    }
    for (const ColorEncoding encoding : {ColorEncoding::srgb, ColorEncoding::none}) {
        const TexturePixels pixels = pixels_of(encoding == ColorEncoding::srgb ? encoded : plain, encoding);
        CHECK(pixels.is_encoded);
        CHECK(pixels.width == 256);
        CHECK(pixels.height == 1);
        REQUIRE(pixels.bytes.size() == 768);
        for (std::size_t i = 0; i < 768; ++i) CHECK(pixels.bytes[i] == static_cast<std::byte>(i / 3));
    }
}

TEST_CASE("textures of programs: a picture with one intensity between those of 8 bits is stored in 16") {
    const TexturePixels pixels = pixels_of(
        {65535, intensity_of(100), static_cast<std::uint16_t>(intensity_of(100) + 1)}, ColorEncoding::srgb);
    CHECK_FALSE(pixels.is_encoded);
    const int last = intensity_of(100) + 1;
    REQUIRE(pixels.bytes.size() == 18);
    CHECK(pixels.bytes[0] == std::byte{255});
    CHECK(pixels.bytes[16] == static_cast<std::byte>(last >> 8));
    CHECK(pixels.bytes[17] == static_cast<std::byte>(last & 255));
}

TEST_CASE("generate: each picture becomes one file next to the program, exact to the byte if it has 8 bits") {
    for (const char* const target : {"cpp", "opengl"}) {
        const fs::path folder = scratch_directory(), program = folder / target;
        write_file(folder / "square.obj", k_square);
        write_file(folder / "a.ppm", small_ppm(1));
        write_file(folder / "b.ppm", small_ppm(2));
        const fs::path scene = write_file(folder / "scene.toml", scene_with("aba"));
        succeeded(run_candela({"generate", scene.string(), "--target", target, "-o", program.string()}));
        CHECK(read_file(program / "texture_0.ppm") == small_ppm(1));
        CHECK(read_file(program / "texture_1.ppm").starts_with("P6\n128 2\n65535\n"));
        CHECK(read_file(program / "texture_1.ppm").size() == small_ppm(2).size());
        CHECK_FALSE(fs::exists(program / "texture_2.ppm"));
        CHECK(holds(read_file(program / "scene.cpp"), "// a.ppm"));
    }
}

TEST_CASE("verify: a C++ program has the textures of parameters, for each rate at which light is evaluated") {
    const fs::path folder = scratch_directory();
    std::string soft = "P6\n16 16\n255\n";  // values change by a few steps from texel to texel
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x)
            for (const int value :
                 {90 + 8 * std::abs(x - 8), 200 - 9 * std::abs(y - 8), 60 + 5 * std::abs(x - y)})
                soft += static_cast<char>(value);
    write_file(folder / "soft.ppm", soft);
    const fs::path scene = write_file(
        folder / "scene.toml",
        "version = 1\n[observer]\nposition = [0, 1.5, 5]\nlook_at = [0, 0, 0]\n[image]\nwidth = 160\nheight "
        "= "
        "100\n[[light]]\ntype = \"point\"\nposition = [-2, 4, 3]\nintensity = 20\n[[light]]\ntype = "
        "\"ambient\"\n"
        "[[object]]\nname = \"ball\"\ntype = \"sphere\"\nradius = 0.9\nposition = [-1, 0, 0]\nshading = "
        "\"phong\"\nreflection = \"disney\"\n[object.material]\nmetallic = { texture = \"soft.ppm\", channel "
        "= "
        "\"r\", transform = { scale = [3, 2], rotation = 20, offset = [0.3, 0.1] } }\nroughness = { texture "
        "= "
        "\"soft.ppm\", channel = \"g\", scale = -0.5, offset = 0.9 }\n"
        "[[object]]\nname = \"ring\"\ntype = \"torus\"\nposition = [1.2, 0, 0]\nrotation = [60, 20, "
        "0]\nshading = "
        "\"gouraud\"\nreflection = \"phong\"\ncolor = { texture = \"soft.ppm\", scale = [0.9, 1, 0.8], "
        "transform = { rotation = 30 } }\n[object.material]\nkd = { "
        "texture = "
        "\"soft.ppm\", wrap = \"clamp\", scale = [1, 0.7, 0.2] }\nshininess = { texture = \"soft.ppm\", "
        "channel = "
        "\"b\", scale = 40, offset = 4 }\n"
        "[[object]]\nname = \"floor\"\ntype = \"cube\"\nsize = 3\nposition = [0, -3, 0]\nshading = "
        "\"flat\"\nreflection = \"phong\"\n[object.material]\nks = 0\nkd = { texture = \"soft.ppm\", "
        "encoding = "
        "\"linear\" }\n");
    const CommandResult result = run_candela({"verify", scene.string(), "--target", "cpp"});
    CHECK(succeeded(result).out.find("match") != std::string::npos);
    succeeded(
        run_candela({"generate", scene.string(), "--target", "cpp", "-o", (folder / "program").string()}));
    const std::string program = read_file(folder / "program/scene.cpp");
    CHECK(holds(program, "own.disney_material = disney_prepare(m);"));
    CHECK(holds(program, "m.kd.y = number_of(texel_0.y, 0.7f, 0.0f, 0.0f, 1.0f);"));
}

TEST_CASE("generate: the program of a scene without textures does not mention textures") {
    for (const char* const target : {"cpp", "opengl"}) {
        const fs::path program = scratch_directory() / target;
        succeeded(run_candela({"generate", "--target", target, "-o", program.string()}));
        for (const char* const word : {"color_texture", "ColorTexture", "TEXTURED", "uv_edges"})
            CHECK_FALSE(holds(read_file(program / "scene.cpp"), word));
    }
}

TEST_CASE("generate: a C++ program names a texture that it cannot read, and accepts a repainted one") {
    const fs::path folder = scratch_directory(), program = folder / "program";
    write_file(folder / "square.obj", k_square);
    write_file(folder / "a.ppm", small_ppm(1));
    const fs::path scene = write_file(folder / "scene.toml", scene_with("a"));
    succeeded(run_candela({"generate", scene.string(), "--target", "cpp", "-o", program.string()}));
    succeeded(run_program({"g++", "-std=c++17", "-O1", "-Wall", "-Wextra", "-Werror",
                           (program / "scene.cpp").string(), "-o", (folder / "scene").string()}));
    const auto run = [&] {
        return run_program({(folder / "scene").string(), (folder / "picture.ppm").string()});
    };
    REQUIRE(run().exit_code == 0);
    const std::string before = read_file(folder / "picture.ppm");
    // As GIMP writes it.
    write_file(program / "texture_0.ppm",
               "P6\n# Created by a painter\n1 1\n255\n" + std::string(3, static_cast<char>(250)));
    REQUIRE(run().exit_code == 0);
    const bool is_painted = read_file(folder / "picture.ppm") != before;
    CHECK(is_painted);
    for (const std::string& broken :
         {std::string("P5\n1 1\n255\n0"), std::string("P6\n2 2\n255\n0"), std::string("P6\n0 1\n255\n"),
          std::string("P6\n1 1\n100\n000"), std::string()}) {
        write_file(program / "texture_0.ppm", broken);
        expect(run(), 1, {(program / "texture_0.ppm").string()});
    }
    fs::remove(program / "texture_0.ppm");
    CHECK(run().exit_code == 1);
}

TEST_CASE("generate: a model with textures becomes a program, and a page that contains them") {
    const fs::path folder = scratch_directory();
    const fs::path model = write_file(folder / "square.obj", k_square);
    write_file(folder / "square.mtl", "newmtl tiles\nKd 1 1 1\nmap_Kd tiles.ppm\n");
    write_file(folder / "tiles.ppm", small_ppm(1));
    succeeded(run_candela({"generate", model.string(), "--target", "cpp", "-o", (folder / "cpp").string()}));
    CHECK(read_file(folder / "cpp/texture_0.ppm") == small_ppm(1));
    succeeded(
        run_candela({"generate", model.string(), "--target", "webgl", "-o", (folder / "page").string()}));
    CHECK(holds(read_file(folder / "page/scene.html"), R"("title":"tiles.ppm","width":128)"));
}

TEST_CASE("generate: pictures too large for a page are refused with their size", "[whole]") {
    const fs::path folder = scratch_directory();
    write_file(folder / "square.obj", k_square);
    write_file(folder / "a.ppm", "P6\n6000 6000\n255\n" + std::string(std::size_t{3} * 6000 * 6000, '\x50'));
    const fs::path scene = write_file(folder / "scene.toml", scene_with("a"));
    expect(run_candela({"generate", scene.string(), "--target", "webgl", "-o", (folder / "page").string()}),
           1, {"more than 96 MiB", "6000 x 6000 pixels"});
    CHECK_FALSE(fs::exists(folder / "page"));
}
