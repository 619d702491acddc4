#include <fmt/format.h>

#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"

using candela::ColorEncoding;
using candela::Mesh;
using candela::MeshRequest;
using candela::Shape;
using candela::Vec3;
using Catch::Approx;

namespace {

Mesh mesh_of_text(const char* name, const std::string& text, ColorEncoding encoding = ColorEncoding::srgb) {
    const auto file = write_file(scratch_directory() / name, text);
    return candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}}),
                               {.color = true, .color_management = encoding}, {},
                               *instance<candela::ShadingModel>("phong"));
}

constexpr const char* k_ply =
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
    "property uchar red\nproperty uchar green\nproperty uchar blue\n"
    "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
    "-1 -1 0 255 0 0\n1 -1 0 0 255 0\n-1 1 0 128 0 255\n3 0 1 2\n";

/// sRGB decoding, from the text of IEC 61966-2-1.
double encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055;
}

}  // namespace

TEST_CASE("shape/mesh: colours of PLY and OBJ files are encoded like those of scenes") {
    // 128 and 0.5 in linear light: published tables of sRGB.
    const Mesh ply = mesh_of_text("colors.ply", k_ply);
    REQUIRE(ply.color.size() == 3);
    CHECK(ply.color.x[2] == Approx(0.21586050).epsilon(1e-5));
    CHECK(ply.color.span()[0] == Vec3{1, 0, 0});
    const Mesh obj = mesh_of_text("colors.obj", "v 0 0 0 0.5 0 1\nv 1 0 0 0 1 0\nv 0 1 0 1 1 1\nf 1 2 3\n");
    REQUIRE(obj.color.size() == 3);
    CHECK(obj.color.x[0] == Approx(0.21404114).epsilon(1e-5));
    SECTION("without colour management they are used as they are") {
        const Mesh plain = mesh_of_text("colors.ply", k_ply, ColorEncoding::none);
        CHECK(plain.color.x[2] == Approx(128.0 / 255));
    }
}

TEST_CASE("shape/mesh: colours are absent unless requested, and if the object turns them off") {
    const auto file = write_file(scratch_directory() / "colors.ply", k_ply);
    const auto shading = instance<candela::ShadingModel>("phong");
    CHECK(candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}}), {}, {}, *shading)
              .color.empty());
    CHECK(candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}, {"vertex_colors", false}}),
                              {.color = true}, {}, *shading)
              .color.empty());
}

TEST_CASE(
    "shape/mesh: triangles of different colours that meet at a vertex share its normal, not its colour") {
    // Two triangles that are folded by 30 degrees along an edge, each with vertices of its own.
    const Mesh mesh = mesh_of_text("fold.obj",
                                   "v 0 0 0 1 0 0\nv 0 0 1 1 0 0\nv -1 0 0 1 0 0\n"
                                   "v 0 0 0 0 0 1\nv 0.866 0.5 0 0 0 1\nv 0 0 1 0 0 1\nf 1 3 2\nf 4 6 5\n");
    REQUIRE(mesh.vertex_count() == 6);
    for (std::size_t corner = 0; corner < 6; ++corner) {
        const std::uint32_t vertex = mesh.indices[corner];
        CHECK(mesh.color.span()[vertex] == (corner < 3 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}));
    }
    std::vector<Vec3> at_origin;
    for (const candela::MeshVertex& vertex : mesh.vertices)
        if (vertex.position == Vec3{}) at_origin.push_back(vertex.normal);
    REQUIRE(at_origin.size() == 2);
    CHECK(at_origin[0] == at_origin[1]);
}

TEST_CASE(
    "vertex colours: a pixel's colour is interpolated by its barycentric coordinates, in linear light") {
    const auto directory = scratch_directory();
    write_file(directory / "triangle.ply", k_ply);
    constexpr int k_size = 32;
    write_file(
        directory / "scene.toml",
        fmt::format("version = 1\nroom = {{ width = 10, height = 10, depth = 10 }}\n"
                    "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\n"
                    "projection = \"orthographic\"\nheight = 2\n"
                    "[image]\nwidth = {0}\nheight = {0}\nsamples = 1\n[reflection]\nmodel = \"lambert\"\n"
                    "[[light]]\ntype = \"ambient\"\nintensity = 0.5\n"
                    "[[object]]\ntype = \"mesh\"\nfile = \"triangle.ply\"\ncolor = [255, 255, "
                    "255]\n[object.material]\nka = 1\n",
                    k_size));
    // The vertices' colours, in linear light.
    const double colors[3][3] = {{1, 0, 0}, {0, 1, 0}, {0.21586050, 0, 1}};
    for (const char* const shading : {"phong", "gouraud", "flat"}) {
        const CommandResult result = run_candela({"render", (directory / "scene.toml").string(), "--shading",
                                                  shading, "-o", (directory / "a.ppm").string()});
        INFO(shading << result.err);
        REQUIRE(result.exit_code == 0);
        const std::string image = read_file(directory / "a.ppm");
        const std::size_t header = image.size() - 3 * k_size * k_size;
        for (int y = 0; y < k_size; ++y) {
            for (int x = 0; x + 1 < y; ++x) {  // within the lower left triangle
                const double right = (x + 0.5) / k_size, up = 1 - (y + 0.5) / k_size;
                const bool is_flat = shading == std::string("flat");
                const double b[3] = {is_flat ? 1.0 / 3 : 1 - right - up, is_flat ? 1.0 / 3 : right,
                                     is_flat ? 1.0 / 3 : up};
                for (int channel = 0; channel < 3; ++channel) {
                    double linear = 0;
                    for (int k = 0; k < 3; ++k) linear += 0.5 * b[k] * colors[k][channel];
                    const int got = static_cast<unsigned char>(
                        image[header + static_cast<std::size_t>(3 * (k_size * y + x) + channel)]);
                    INFO(x << " " << y << " channel " << channel);
                    CHECK(std::abs(got - 255 * encoded(linear)) <= 0.51);
                }
            }
        }
    }
}
