// Parameters that vary over a mesh's vertices, and second texture coordinates, against pictures computed by
// hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

#include "golden/image.h"
#include "golden/textured_square.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/gltf_square.h"

namespace {

using Channels = std::array<double, 3>;

/// A square of two metres that fills the picture and faces the observer, from whom the light comes: N = L =
/// V, and a Lambert surface has its kd as its intensity.
std::string scene(const std::string& mesh, const std::string& material, const std::string& object = {}) {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = 2\n"
        "[image]\nwidth = {0}\nheight = {0}\ncolor_management = \"none\"\nbackground = [0, 0, 255]\n"
        "[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"lambert\"\n[[light]]\ntype = "
        "\"directional\"\ndirection = [0, 0, -1]\n[[object]]\nname = \"square\"\ntype = \"mesh\"\nfile = "
        "\"{1}\"\n{2}\n[object.material]\nka = 0\n{3}\n",
        k_size, mesh, object, material);
}

/// Worn to the right and rough to the top; colours as bytes.
constexpr const char* k_ply =
    "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
    "property float wear\nproperty uchar red\nproperty uchar green\nproperty uchar blue\nproperty uchar "
    "alpha\n"
    "property double rough\nelement face 2\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 0 255 0 255 0 0.25\n1 -1 0 1 255 255 255 255 0.25\n1 1 0 1 255 255 0 255 0.75\n"
    "-1 1 0 0 255 0 0 0 0.75\n3 0 1 2\n3 0 2 3\n";

Image of_ply(const std::string& material, const std::string& object = {}) {
    const auto folder = scratch_directory();
    write_file(folder / "square.ply", k_ply);
    return render_floats(folder, scene("square.ply", material, object));
}

/// From 0 at the left edge, or the bottom, to 1 at the other.
double across(int x) { return (x + 0.5) / k_size; }
double upwards(int y) { return 1 - (y + 0.5) / k_size; }

Channels grey(double value) { return {value, value, value}; }

/// The picture as PNG, whose texels are pixels.
std::string picture_png() {
    std::vector<RgbaPixel> pixels;
    for (int y = 0; y < k_size; ++y)
        for (int x = 0; x < k_size; ++x)
            pixels.push_back({static_cast<std::uint8_t>(4 * x), static_cast<std::uint8_t>(12 * y), 100, 255});
    return png(k_size, k_size, pixels);
}

}  // namespace

TEST_CASE("golden: a parameter takes the numbers of the vertices, interpolated over triangles") {
    const auto of_wear = [](const std::string& more) {
        GltfSquare file;
        file.primitive()["attributes"]["_WEAR"] = file.floats("SCALAR", {0, 1, 1, 0});
        const auto folder = scratch_directory();
        write_file(folder / "a.glb", file.glb());
        return render_floats(folder,
                             scene("a.glb", "kd = { attribute = \"_WEAR\", channel = \"r\"" + more + " }",
                                   "color = [255, 255, 255]"));
    };
    require_pixels(of_wear(""), [](int x, int) { return grey(across(x)); });
    require_pixels(of_wear(", scale = -0.5, offset = [0.5, 0.75, 1]"), [](int x, int) {
        return Channels{0.5 - 0.5 * across(x), 0.75 - 0.5 * across(x), 1 - 0.5 * across(x)};
    });
    SECTION("within its range") {
        require_pixels(of_wear(", scale = 4, offset = -1"),
                       [](int x, int) { return grey(std::clamp(4 * across(x) - 1, 0.0, 1.0)); });
    }
}

TEST_CASE("golden: properties of a PLY file are attributes, with colours or without") {
    // The colours multiply: red is 1, green grows to the right, blue to the bottom.
    require_pixels(of_ply("kd = { attribute = \"rough\", channel = \"r\" }", "color = [255, 255, 255]"),
                   [](int x, int y) {
                       const double kd = 0.25 + 0.5 * upwards(y);
                       return Channels{kd, kd * across(x), kd * (1 - upwards(y))};
                   });
    SECTION("of which any channel is one") {
        require_pixels(of_ply("kd = { attribute = \"color\", channel = \"b\" }", "color = [255, 255, 255]"),
                       [](int x, int y) {
                           const double kd = 1 - upwards(y);
                           return Channels{kd, kd * across(x), kd * kd};
                       });
    }
}

TEST_CASE("golden: the alpha of the vertices may be an object's opacity") {
    // Over blue.
    require_pixels(
        of_ply("kd = 1\nopacity = { attribute = \"color\", channel = \"a\" }", "color = [255, 255, 255]"),
        [](int x, int y) {
            const double alpha = across(x);
            return Channels{alpha, alpha * across(x), alpha * (1 - upwards(y)) + 1 - alpha};
        });
}

TEST_CASE("golden: an opacity that is a product covers by all of its factors") {
    // The picture's green grows to the bottom, the vertices' alpha to the right.
    const auto folder = scratch_directory();
    write_file(folder / "p.png", picture_png());
    GltfSquare file;
    file.primitive()["attributes"]["COLOR_0"] =
        file.floats("VEC4", {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 0});
    write_file(folder / "a.glb", file.glb());
    const auto covered = [&](const char* more) {
        return render_floats(
            folder, scene("a.glb",
                          fmt::format("kd = 1\nopacity = [{{ texture = \"p.png\", channel = \"g\" }}, {{ "
                                      "attribute = \"color\", channel = \"a\", scale = 0.5 }}]\n{}",
                                      more),
                          "color = [255, 0, 0]"));
    };
    const auto opacity = [](int x, int y) { return green(y) * 0.5 * across(x); };
    require_pixels(
        covered(""), [&](int x, int y) { return Channels{opacity(x, y), 0, 1 - opacity(x, y)}; }, 3e-4);
    SECTION("and the product is what a cutoff cuts") {
        require_pixels(covered("opacity_cutoff = 0.101"), [&](int x, int y) {
            return opacity(x, y) >= 0.101 ? Channels{1, 0, 0} : Channels{0, 0, 1};
        });
    }
}

TEST_CASE("golden: a model with prepared constants has them at each point") {
    // Where N = L = V, and F(0) = 0.04: Walter et al. (2007), D = 1 / (pi alpha^2), G = 1; times pi / 4.
    const Image image = of_ply("kd = 0\nks = 1\nior = 1.5\nroughness = { attribute = \"rough\" }",
                               "color = [255, 255, 255]\nreflection = \"ggx\"");
    for (int y = 0; y < k_size; ++y) {
        INFO("row " << y);
        const double roughness = 0.25 + 0.5 * upwards(y), red = 0.04 / (4 * roughness * roughness);
        REQUIRE(std::abs(static_cast<double>(image.at(3, y).x) - red) < 2e-5);
    }
}

TEST_CASE("golden: Gouraud shading has the numbers of its vertices, and a flat face those of its centroid") {
    const auto kd_of = [](const char* shading) {
        return of_ply("kd = { attribute = \"wear\", channel = \"r\" }",
                      fmt::format("color = [255, 255, 255]\nshading = \"{}\"", shading));
    };
    const Image gouraud = kd_of("gouraud");
    for (int x = 0; x < k_size; ++x)
        CHECK(std::abs(static_cast<double>(gouraud.at(x, 4).x) - across(x)) < 2e-6);
    // Below the diagonal, two of three vertices are worn.
    const Image flat = kd_of("flat");
    CHECK(std::abs(static_cast<double>(flat.at(6, 6).x) - 2.0 / 3) < 2e-6);
    CHECK(std::abs(static_cast<double>(flat.at(1, 1).x) - 1.0 / 3) < 2e-6);
}

TEST_CASE("golden: a texture is placed by the second texture coordinates, others by the first") {
    // In the file, the second ones are (v, 1 - u) of the first.
    GltfSquare file;
    file.primitive()["attributes"]["TEXCOORD_1"] = file.floats("VEC2", {1, 1, 1, 0, 0, 0, 0, 1});
    const auto folder = scratch_directory();
    write_file(folder / "a.glb", file.glb());
    write_file(folder / "p.png", picture_png());
    const auto shown = [&](const std::string& material, const std::string& object = {}) {
        return render_floats(folder, scene("a.glb", material, object));
    };
    const auto texel = [](int column, int row) { return Channels{red(column), green(row), k_blue}; };
    require_pixels(
        shown("kd = { texture = \"p.png\", uv = 1 }", "color = [255, 255, 255]"),
        [&](int x, int y) { return texel(y, k_size - 1 - x); }, 3e-4);
    SECTION("both at once") {
        require_pixels(
            shown("kd = { texture = \"p.png\", uv = 1, channel = \"g\" }", "color = { texture = \"p.png\" }"),
            [&](int x, int y) {
                const Channels color = texel(x, y);
                const double kd = green(k_size - 1 - x);
                return Channels{kd * color[0], kd * color[1], kd * color[2]};
            },
            3e-4);
    }
}
