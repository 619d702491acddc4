// Textured pictures, computed by hand: a surface that shows its texture unchanged, pixel by pixel.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "golden/image.h"
#include "support/command.h"
#include "support/expect.h"

namespace {

/// A square of two metres in the plane z = 0 that faces the observer, covered once by the picture.
constexpr const char* k_square =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n";

/// A portable pixmap of grey texels, rows from the top.
std::string grey_ppm(int width, int height, const std::vector<int>& values) {
    std::string text = fmt::format("P6\n{} {}\n255\n", width, height);
    for (const int value : values) text.append(3, static_cast<char>(value));
    return text;
}

/// The square fills the picture. A Lambert surface with kd = 1 under a light from the observer reflects its
/// colour, which is the texture's.
std::string scene(int size, const std::string& object, const char* color_management = "none") {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 2\n"
        "[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"{2}\"\n[shading]\nmodel = \"phong\"\n"
        "[reflection]\nmodel = \"lambert\"\n[[light]]\ntype = \"directional\"\ndirection = [0, 0, -1]\n"
        "[[object]]\nname = \"square\"\ntype = \"mesh\"\nfile = \"square.obj\"\n{1}\n"
        "[object.material]\nka = 0\nkd = 1\n",
        size, object, color_management);
}

/// `placed`: the other keys of the texture.
Image textured(const std::string& texture, int size, const std::string& placed = "",
               const std::string& more = "", const char* color_management = "none") {
    const auto folder = scratch_directory();
    write_file(folder / "square.obj", k_square);
    write_file(folder / "texture.ppm", texture);
    const std::string color = "color = { texture = \"texture.ppm\"" + placed + " }\n";
    return render_floats(folder, scene(size, color + more, color_management));
}

bool is_about(float value, double expected) { return std::abs(static_cast<double>(value) - expected) < 2e-4; }

}  // namespace

TEST_CASE("golden: a texture whose texels are pixels is shown unchanged") {
    std::vector<int> texels;
    for (int i = 0; i < 64; ++i) texels.push_back(4 * i);
    const Image image = textured(grey_ppm(8, 8, texels), 8);
    for (int y = 0; y < 8; ++y) {
        for (int x = 0; x < 8; ++x) {
            INFO("pixel " << x << ", " << y);
            CHECK(is_about(image.at(x, y).x, 4.0 * (8 * y + x) / 255));
        }
    }
}

TEST_CASE("golden: a magnified checkerboard is bilinear between the centres of its texels") {
    // Two by two texels on 32 pixels: a texel is 16 wide, and the picture repeats around it.
    const Image image = textured(grey_ppm(2, 2, {255, 0, 0, 255}), 32);
    const auto white_across = [](int pixel) {
        // The share of column 0 at the pixel's centre: 1 at the centre of column 0 (8), 0 at that of column 1
        // (24).
        const double at = pixel + 0.5, from_first = std::abs(at - 8) / 16;
        return from_first <= 1 ? 1 - from_first : from_first - 1;
    };
    for (int y = 0; y < 32; ++y) {
        for (int x = 0; x < 32; ++x) {
            const double a = white_across(x), b = white_across(y);
            INFO("pixel " << x << ", " << y);
            REQUIRE(is_about(image.at(x, y).x, a * b + (1 - a) * (1 - b)));
        }
    }
}

TEST_CASE("golden: a checkerboard finer than the pixels is shown as its mean") {
    std::vector<int> texels;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) texels.push_back((x + y) % 2 == 0 ? 255 : 0);
    const Image image = textured(grey_ppm(64, 64, texels), 16);
    for (int y = 0; y < 16; ++y)
        for (int x = 0; x < 16; ++x) REQUIRE(is_about(image.at(x, y).x, 0.5));
}

TEST_CASE("golden: a minified ramp shows the means of the texels in each pixel") {
    std::vector<int> texels;
    for (int y = 0; y < 64; ++y)
        for (int x = 0; x < 64; ++x) texels.push_back(4 * x);
    const Image image = textured(grey_ppm(64, 64, texels), 16);
    // Four texels per pixel: 4 (4x + 1.5) / 255.
    for (int x = 0; x < 16; ++x) REQUIRE(is_about(image.at(x, 7).x, 4 * (4 * x + 1.5) / 255));
}

TEST_CASE("golden: the colours of a texture are decoded like those of objects") {
    // 188 is 0.502886 in linear light (IEC 61966-2-1).
    const Image image = textured(grey_ppm(1, 1, {188}), 4, "", "", "srgb");
    CHECK(is_about(image.at(2, 2).x, std::pow((188.0 / 255 + 0.055) / 1.055, 2.4)));
    SECTION("unless the scene's are not") {
        const Image product = textured(grey_ppm(1, 1, {188}), 4, "", "", "none");
        CHECK(is_about(product.at(2, 2).x, 188.0 / 255));
    }
}

TEST_CASE("golden: in perspective the mip level follows the footprint of the pixel") {
    // A floor of 200 x 200 metres with a checkerboard of half-metre squares, from one metre above it. Near
    // the horizon a pixel covers many of them and is grey.
    const auto folder = scratch_directory();
    write_file(
        folder / "floor.obj",
        "v -100 0 100\nv 100 0 100\nv 100 0 -100\nv -100 0 -100\nvt 0 0\nvt 200 0\nvt 200 200\nvt 0 200\n"
        "vn 0 1 0\nf 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
    write_file(folder / "texture.ppm", grey_ppm(2, 2, {255, 0, 0, 255}));
    const Image image = render_floats(
        folder,
        "[room]\nwidth = 300\nheight = 300\ndepth = 300\n"
        "[observer]\nposition = [0, 1, 90]\nlook_at = [0, 1, 0]\nfov = 60\n"
        "[image]\nwidth = 200\nheight = 200\ncolor_management = \"none\"\n[shading]\nmodel = \"phong\"\n"
        "[reflection]\nmodel = \"lambert\"\n[[light]]\ntype = \"directional\"\ndirection = [0, -1, 0]\n"
        "[[object]]\ntype = \"mesh\"\nfile = \"floor.obj\"\n"
        "color = { texture = \"texture.ppm\" }\n[object.material]\nka = 0\nkd = 1\n");
    const auto contrast = [&](int row) {
        float low = 1, high = 0;
        for (int x = 60; x < 140; ++x) {
            low = std::min(low, image.at(x, row).x);
            high = std::max(high, image.at(x, row).x);
        }
        return high - low;
    };
    // Row 199 looks down by almost 30 degrees: two metres away, where a pixel is a centimetre.
    CHECK(contrast(199) > 0.7f);
    // One pixel below the horizon is 173 metres away, beyond the floor; at five pixels, 35 metres: a pixel
    // covers seven metres along the view, fourteen squares.
    CHECK(contrast(105) < 0.02f);
    CHECK(is_about(image.at(100, 105).x, 0.5));
}

TEST_CASE(
    "golden: a textured picture is the same to the byte for any number of threads and each triangle count") {
    const auto folder = scratch_directory();
    std::vector<int> texels;
    for (int i = 0; i < 61 * 43; ++i) texels.push_back(i * 37 % 256);
    write_file(folder / "texture.ppm", grey_ppm(61, 43, texels));
    const std::string text =
        "version = 1\n[observer]\nposition = [0.3, 1.6, 4.2]\nlook_at = [0, 0, 0]\n[image]\nwidth = 333\n"
        "height = 217\nsamples = 4\n[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"ggx\"\n"
        "[[light]]\ntype = \"point\"\nposition = [-2, 3, 3]\nintensity = 14\n[[object]]\ntype = \"teapot\"\n"
        "color = { texture = \"texture.ppm\" }\n[[object]]\ntype = \"sphere\"\nposition = [1.6, 0, "
        "0.4]\nradius = "
        "0.5\n"
        "color = { texture = \"texture.ppm\", wrap = \"clamp\" }\nshading = \"gouraud\"\n";
    write_file(folder / "scene.toml", text);
    std::string first;
    for (const char* const threads : {"1", "2", "5"}) {
        const auto file = folder / fmt::format("{}.ppm", threads);
        succeeded(run_candela(
            {"render", (folder / "scene.toml").string(), "-o", file.string(), "--threads", threads}));
        if (first.empty()) first = read_file(file);
        CHECK(read_file(file) == first);
    }
}

TEST_CASE(
    "golden: flat faces have the texture's colour at their centroid, and Gouraud shading that at vertices") {
    std::vector<int> texels;
    for (int y = 0; y < 3; ++y)
        for (int x = 0; x < 3; ++x) texels.push_back(100 * x + 20 * y);
    // The centroid of the lower right triangle is (2/3, 1/3): halfway between texels 1 and 2.
    const Image flat = textured(grey_ppm(3, 3, texels), 8, ", wrap = \"clamp\"", "shading = \"flat\"");
    CHECK(is_about(flat.at(6, 6).x, (100 * 1.5 + 20 * 1.5) / 255));
    CHECK(is_about(flat.at(3, 7).x, (100 * 1.5 + 20 * 1.5) / 255));
    const Image gouraud = textured(grey_ppm(3, 3, texels), 8, ", wrap = \"clamp\"", "shading = \"gouraud\"");
    // Corner values 0 (top left), 200 (top right), 40 (bottom left), 240 (bottom right): linear over the
    // square.
    for (int y = 0; y < 8; ++y)
        for (int x = 0; x < 8; ++x)
            REQUIRE(is_about(gouraud.at(x, y).x, (200 * (x + 0.5) / 8 + 40 * (y + 0.5) / 8) / 255));
}
