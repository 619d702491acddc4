#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <vector>

#include "candela/parallel.h"
#include "read_mesh.h"
#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"
#include "support/text.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

/// A mesh as careless exporters write it: every triangle with three vertices of its own, and no normals.
std::string soup_of(const Mesh& mesh) {
    std::string text;
    for (const std::uint32_t corner : mesh.indices) {
        const Vec3 p = mesh.position.span()[corner];
        text += fmt::format("v {} {} {}\n", p.x, p.y, p.z);
    }
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        text += fmt::format("f {} {} {}\n", i + 1, i + 2, i + 3);
    }
    return text;
}

/// The mesh with derivatives, as a reflection model with a tangent requests them.
Mesh with_derivatives(const std::string& obj) {
    return candela::build_mesh(
        *instance<Shape>("mesh", {{"file", write_file(scratch_directory() / "d.obj", obj).string()}}),
        {.uv = true, .derivatives = true}, {}, *instance<candela::ShadingModel>("phong"));
}

Mesh built(const Shape& shape) {
    return candela::build_mesh(shape, {}, {}, *instance<candela::ShadingModel>("phong"));
}

constexpr const char* k_triangle = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

TEST_CASE("shape/mesh: duplicated vertices without normals become smooth and closed") {
    const Mesh sphere = built(*instance<Shape>("sphere", {{"radius", 1.0}, {"segments", std::int64_t{48}}}));
    const Mesh mesh = mesh_of(write_file(scratch_directory() / "soup.obj", soup_of(sphere)));
    CHECK(mesh.closed);
    double worst = 1;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        worst = std::min(worst, dot(exact(mesh.vertices[i].normal), unit(exact(mesh.position.span()[i]))));
    }
    // A facet's own normal is off by up to 1 - cos(3.75 degrees * sqrt 2) = 0.004 at its corners.
    CHECK(worst > 0.9995);
}

TEST_CASE("shape/mesh: normals from the file take precedence over those of the shading model") {
    const Mesh mesh =
        mesh_of(write_file(scratch_directory() / "n.obj",
                           std::string(k_triangle) + "vn 1 0 0\nvn 0 1 0\nvn 0 0 2\nf 1//1 2//2 3//3\n"));
    CHECK(mesh.triangle_count() == 1);
    CHECK(agree(mesh.vertices[mesh.indices[0]].normal, Vec3{1, 0, 0}, 1e-6));
    CHECK(agree(mesh.vertices[mesh.indices[1]].normal, Vec3{0, 1, 0}, 1e-6));
    CHECK(agree(mesh.vertices[mesh.indices[2]].normal, Vec3{0, 0, 1}, 1e-6));
    CHECK(mesh.face_normal.span()[0] == Vec3{0, 0, 1});
}

TEST_CASE("shape/mesh reads the formats that it names, by extension, and no others") {
    const auto directory = scratch_directory();
    const auto validation_error = [&](const char* name, const std::string& content) {
        return message_of([&] { mesh_of(write_file(directory / name, content)); });
    };
    const std::string triangle = std::string(k_triangle) + "f 1 2 3\n";
    CHECK(validation_error("a.OBJ", triangle).empty());
    for (const char* const name : {"a.dae", "a.3ds", "a.off", "a", "a.ob", "a.toml"}) {
        INFO(name);
        CHECK(holds(validation_error(name, triangle),
                    "unsupported mesh extension; expected .obj, .ply, .stl, .gltf or .glb"));
    }
    // The file's content does not matter.
    const std::string off = "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK_FALSE(validation_error("off.obj", off).empty());
    CHECK_FALSE(validation_error("off.stl", off).empty());
}

TEST_CASE("shape/mesh: the shading model replaces normals that are zero in the file") {
    const Mesh mesh = mesh_of(write_file(scratch_directory() / "n.obj",
                                         std::string(k_triangle) + "vn 0 0 0\nvn 0 1 0\nf 1//1 2//2 3//1\n"));
    CHECK(agree(mesh.vertices[mesh.indices[0]].normal, Vec3{0, 0, 1}, 1e-6));
    CHECK(agree(mesh.vertices[mesh.indices[1]].normal, Vec3{0, 1, 0}, 1e-6));
}

TEST_CASE("shape/mesh: polygons are cut into triangles") {
    const Mesh mesh = mesh_of(
        write_file(scratch_directory() / "quad.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n"));
    CHECK(mesh.triangle_count() == 2);
}

TEST_CASE("shape/mesh reads PLY, STL and glTF") {
    const auto directory = scratch_directory();
    const auto ply = write_file(
        directory / "a.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
    const auto stl = write_file(directory / "a.stl",
                                "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex "
                                "0 1 0\nendloop\nendfacet\n"
                                "facet normal 1 0 0\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 0 0 "
                                "1\nendloop\nendfacet\nendsolid a\n");
    // Three float positions, three 16-bit indices; a node that moves them by (0, 0, 5).
    const auto gltf = write_file(directory / "a.gltf",
                                 R"({"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0, "translation": [0, 0, 5]}],
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1}]}],
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [0, 0, 0], "max": [1, 1, 0]},
                          {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
            "bufferViews": [{"buffer": 0, "byteOffset": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
            "buffers": [{"byteLength": 42, "uri": "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAABAAIA"}]})");
    CHECK(mesh_of(ply).triangle_count() == 1);
    CHECK(mesh_of(gltf).triangle_count() == 1);
    CHECK(mesh_of(gltf).position.span()[0].z == 5);
    // Facets at right angles share a normal only where no edge is hard.
    CHECK(has_hard_edge(mesh_of(stl)));
    const Mesh facets = mesh_of(stl, 180);
    CHECK(facets.triangle_count() == 2);
    const float half = 1 / std::sqrt(2.0f);
    CHECK(agree(facets.vertices[facets.indices[0]].normal, Vec3{half, 0, half}, 1e-6));
}

TEST_CASE("a teapot without its normals and shared vertices looks like the teapot") {
    const Mesh original = built(*instance<Shape>("teapot"));
    // Its lid and its rim have edges that the built-in one smooths.
    const Mesh read = mesh_of(write_file(scratch_directory() / "teapot.obj", soup_of(original)), 180);
    REQUIRE(read.triangle_count() == original.triangle_count());
    for (std::size_t corner = 0; corner < read.indices.size(); ++corner) {
        REQUIRE(agree(read.vertices[read.indices[corner]].normal,
                      original.vertices[original.indices[corner]].normal, 1e-4, 1e-4));
    }
}

TEST_CASE(
    "shape/mesh: derivatives along texture coordinates are those of the map, on every triangle of a plane") {
    // p(u, v) = u (2, 1, 0) + v (-1, 3, 1), at u, v in {0, 1} x {0, 2}.
    const Mesh mesh = with_derivatives(
        "v 0 0 0\nv 2 1 0\nv 0 7 2\nv -2 6 2\nvt 0 0\nvt 1 0\nvt 1 2\nvt 0 2\nf 1/1 2/2 3/3\nf 1/1 3/3 "
        "4/4\n");
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        CHECK(agree(mesh.dpdu.span()[i], Vec3{2, 1, 0}, 1e-5, 1e-5));
        CHECK(agree(mesh.dpdv.span()[i], Vec3{-1, 3, 1}, 1e-5, 1e-5));
    }
}

TEST_CASE("shape/mesh: derivatives on a cylinder run around it and along it, within the width of a facet") {
    // u once around, v up: dp/du is 2 pi times the unit tangent, dp/dv (0, 3, 0).
    constexpr int k_facets = 48;
    std::string obj;
    for (int i = 0; i <= k_facets; ++i) {
        const double phi = 2 * std::acos(-1.0) * i / k_facets;
        for (const int v : {0, 1})
            obj += fmt::format("v {} {} {}\nvt {} {}\n", std::cos(phi), 3 * v, -std::sin(phi),
                               double(i) / k_facets, v);
    }
    for (int i = 0; i < k_facets; ++i) {
        const int a = 2 * i + 1;
        obj += fmt::format("f {0}/{0} {1}/{1} {2}/{2}\nf {0}/{0} {2}/{2} {3}/{3}\n", a, a + 2, a + 3, a + 1);
    }
    const Mesh mesh = with_derivatives(obj);
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Double3 p = exact(mesh.position.span()[i]), du = exact(mesh.dpdu.span()[i]);
        CHECK(dot(unit(du), Double3{p.z, 0, -p.x}) > std::cos(4 * std::acos(-1.0) / k_facets));
        // The mean over two facets is shorter by 1 - cos(3.75 degrees) = 0.0021, a chord by 0.0007.
        CHECK(agree(length(du), 2 * std::acos(-1.0), 3e-3));
        CHECK(agree(mesh.dpdv.span()[i], Vec3{0, 3, 0}, 1e-4, 1e-4));
    }
}

TEST_CASE("shape/mesh: without texture coordinates, or with useless ones, derivatives are zero") {
    for (const char* const face : {"f 1 2 3\n", "vt 0.5 0.5\nf 1/1 2/1 3/1\n"}) {
        const Mesh mesh = with_derivatives(std::string(k_triangle) + face);
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            CHECK(mesh.dpdu.span()[i] == Vec3{0, 0, 0});
            CHECK(mesh.dpdv.span()[i] == Vec3{0, 0, 0});
        }
    }
}

TEST_CASE("shape/mesh: concave polygons are covered once, by their corners' triangles") {
    // A comb of twenty teeth, 2 wide with a gap of 1, on a back of height 1; once flat and once upright.
    std::string upright, flat, face = "f";
    int corner = 0;
    const auto add = [&](int x, int y) {
        flat += fmt::format("v {} {} 0\n", x, y);
        upright += fmt::format("v 0 {} {}\n", x, y);
        face += fmt::format(" {}", ++corner);
    };
    constexpr int k_teeth = 20;
    add(0, 0);
    add(3 * k_teeth - 1, 0);
    for (int i = k_teeth - 1; i >= 0; --i) {
        add(3 * i + 2, 5);
        add(3 * i, 5);
        if (i > 0) {
            add(3 * i, 1);
            add(3 * i - 1, 1);
        }
    }
    const double area = (3 * k_teeth - 1) + 4 * 2 * k_teeth;
    for (const std::string& vertices : {flat, upright}) {
        const Mesh mesh = mesh_of_text("comb.obj", vertices + face + "\n");
        CHECK(mesh.triangle_count() == static_cast<std::size_t>(corner) - 2);
        double covered = 0;
        for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
            const auto at = [&](std::size_t k) {
                return exact(mesh.position.span()[mesh.indices[3 * t + k]]);
            };
            const Double3 twice = cross(at(1) - at(0), at(2) - at(0));
            // No triangle is turned over.
            CHECK(twice.x + twice.z >= 0);
            covered += (twice.x + twice.z) / 2;
        }
        CHECK(agree(covered, area, 1e-9));
    }
}

TEST_CASE("shape/mesh: contents of a file that Candela leaves out are reported once, in one sentence") {
    const std::string triangle = std::string(k_triangle) + "f 1 2 3\n";
    CHECK(warnings_about("a.obj", triangle).empty());
    const auto said = warnings_about("b.obj", "mtllib a.mtl\nl 1 2\nusemtl b\nl 2 3\np 1\n" + triangle);
    REQUIRE(said.size() == 1);
    CHECK(said[0].ends_with(
        "also has 2 lines, points, a material library and a use of a material, which are left out"));
}

TEST_CASE("shape/mesh: a pipe, a folder and a device are refused without waiting") {
    const auto directory = scratch_directory();
    const auto pipe = directory / "pipe.ply";
    std::filesystem::remove(pipe);
    REQUIRE(::mkfifo(pipe.c_str(), 0600) == 0);
    std::filesystem::create_directory(directory / "folder.obj");
    std::filesystem::remove(directory / "zero.stl");
    std::filesystem::create_symlink("/dev/zero", directory / "zero.stl");
    for (const char* const name : {"pipe.ply", "folder.obj", "zero.stl"}) {
        INFO(name);
        CHECK_THROWS_WITH(mesh_of(directory / name),
                          Catch::Matchers::ContainsSubstring("is not a regular file"));
    }
    // So is a buffer that is a pipe.
    std::filesystem::remove(directory / "a.bin");
    REQUIRE(::mkfifo((directory / "a.bin").c_str(), 0600) == 0);
    const auto gltf = write_file(directory / "p.gltf", R"({"asset": {"version": "2.0"},
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri": "a.bin"}]})");
    CHECK_THROWS_WITH(mesh_of(gltf),
                      Catch::Matchers::ContainsSubstring("names 'a.bin', which is not a regular file"));
}

TEST_CASE(
    "shape/mesh: a glTF file may name files in its folder or below, others only if the scene allows it") {
    const auto directory = scratch_directory();
    std::filesystem::create_directories(directory / "models");
    const std::array<float, 9> corners{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const std::string bytes(reinterpret_cast<const char*>(corners.data()), sizeof corners);
    write_file(directory / "outside.bin", bytes);
    write_file(directory / "models" / "inside.bin", bytes);
    std::filesystem::remove(directory / "models" / "link.bin");
    std::filesystem::create_symlink("../outside.bin", directory / "models" / "link.bin");
    const auto naming = [&](const std::string& uri) {
        return write_file(directory / "models" / "p.gltf", R"({"asset": {"version": "2.0"},
            "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}], "nodes": [{"mesh": 0}],
            "scenes": [{"nodes": [0]}], "scene": 0,
            "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
                           "min": [0, 0, 0], "max": [1, 1, 0]}],
            "bufferViews": [{"buffer": 0, "byteLength": 36}],
            "buffers": [{"byteLength": 36, "uri": ")" + uri + "\"}]}")
            .string();
    };
    const auto triangles = [](const std::string& file, bool allowed) {
        return built(*instance<Shape>("mesh", {{"file", file}, {"allow_outside", allowed}})).triangle_count();
    };
    CHECK(triangles(naming("inside.bin"), false) == 1);
    for (const std::string& uri :
         {std::string("../outside.bin"), std::string("link.bin"), (directory / "outside.bin").string()}) {
        INFO(uri);
        CHECK_THROWS_WITH(triangles(naming(uri), false),
                          Catch::Matchers::ContainsSubstring("outside its own folder") &&
                              Catch::Matchers::ContainsSubstring("allow_outside = true"));
        CHECK(triangles(naming(uri), true) == 1);
    }
}

TEST_CASE("shape/mesh: the number of threads changes nothing") {
    const Mesh sphere = built(*instance<Shape>("sphere", {{"radius", 1.0}, {"segments", std::int64_t{300}}}));
    const auto file = write_file(scratch_directory() / "many.obj", soup_of(sphere));
    Mesh by_one, by_four;
    candela::with_threads(1, [&] { by_one = mesh_of(file, 5); });
    candela::with_threads(4, [&] { by_four = mesh_of(file, 5); });
    CHECK(by_one.indices == by_four.indices);
    CHECK(by_one.position.x == by_four.position.x);
    CHECK(by_one.closed);
    CHECK(by_one.triangle_count() == sphere.triangle_count());
}

TEST_CASE("shape/mesh: reading a long text reports progress, which a scene's progress includes") {
    std::string text;
    for (int i = 0; i < 100000; ++i) text += fmt::format("v {0} 0 0\nv {0} 1 0\nv {0} 0 1\n", 1e-5 * i);
    for (int i = 0; i < 100000; ++i) text += fmt::format("f {} {} {}\n", 3 * i + 1, 3 * i + 2, 3 * i + 3);
    const auto directory = scratch_directory();
    const auto file = write_file(directory / "long.obj", text);
    std::vector<double> told;
    candela::place(*instance<Shape>("mesh", {{"file", file.string()}}), {}, {},
                   [&](double done) { told.push_back(done); });
    REQUIRE(told.size() > 8);
    CHECK(std::ranges::is_sorted(told));
    CHECK(told.front() < 0.2);
    CHECK(told.back() < 1);

    candela::SceneRequest request;
    request.files = {
        write_file(directory / "long.toml",
                   "version = 1\n[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"lambert\"\n"
                   "[observer]\nposition = [0, 0, -4]\nlook_at = [0, 0, 0]\n"
                   "[[object]]\ntype = \"mesh\"\nfile = \"long.obj\"\n")};
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(request, test_registry(), diagnostics);
    REQUIRE(draft);
    REQUIRE_FALSE(diagnostics.has_errors());
    std::vector<double> done;
    candela::build(*draft, test_registry(), diagnostics, 1, [&](std::size_t some, std::size_t all) {
        done.push_back(static_cast<double>(some) / static_cast<double>(all));
    });
    CHECK_FALSE(diagnostics.has_errors());
    CHECK(std::ranges::is_sorted(done));
    CHECK(std::ranges::count_if(done, [](double d) { return d > 0 && d < 0.33; }) >= 8);
    CHECK(done.back() == 1);
}
