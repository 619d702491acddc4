#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <fstream>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

Mesh mesh_of(const std::filesystem::path& file, const char* shading = "phong") {
    return candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}}), {}, {},
                               *instance<candela::ShadingModel>(shading));
}

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

/// With derivatives, as a reflection model with a tangent asks for them.
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

TEST_CASE("shape/mesh: duplicated vertices without normals come out smooth, and closed") {
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

TEST_CASE("shape/mesh: normals from the file go before those of the shading model") {
    const Mesh mesh =
        mesh_of(write_file(scratch_directory() / "n.obj",
                           std::string(k_triangle) + "vn 1 0 0\nvn 0 1 0\nvn 0 0 2\nf 1//1 2//2 3//3\n"));
    CHECK(mesh.triangle_count() == 1);
    CHECK(agree(mesh.vertices[mesh.indices[0]].normal, Vec3{1, 0, 0}, 1e-6));
    CHECK(agree(mesh.vertices[mesh.indices[1]].normal, Vec3{0, 1, 0}, 1e-6));
    CHECK(agree(mesh.vertices[mesh.indices[2]].normal, Vec3{0, 0, 1}, 1e-6));
    CHECK(mesh.face_normal.span()[0] == Vec3{0, 0, 1});
}

TEST_CASE("shape/mesh reads the formats that it names, by their extension, and no other") {
    const auto directory = scratch_directory();
    const auto validation_error = [&](const char* name, const std::string& content) -> std::string {
        try {
            mesh_of(write_file(directory / name, content));
        } catch (const std::exception& problem) {
            return problem.what();
        }
        return "";
    };
    const std::string triangle = std::string(k_triangle) + "f 1 2 3\n";
    CHECK(validation_error("a.OBJ", triangle).empty());
    for (const char* const name : {"a.dae", "a.3ds", "a.off", "a", "a.ob", "a.toml"}) {
        INFO(name);
        CHECK(validation_error(name, triangle).find("extension of a mesh: .obj, .ply, .stl, .gltf or .glb") !=
              std::string::npos);
    }
    // assimp itself would look into the file and find a reader for it.
    const std::string off = "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";
    CHECK_FALSE(validation_error("off.obj", off).empty());
    CHECK_FALSE(validation_error("off.stl", off).empty());
}

TEST_CASE("shape/mesh: where a file's normals are zero, the shading model makes them") {
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
    // Facet normals are not vertex normals: where facets touch, the surface is smooth.
    const Mesh facets = mesh_of(stl);
    CHECK(facets.triangle_count() == 2);
    const float half = 1 / std::sqrt(2.0f);
    CHECK(agree(facets.vertices[facets.indices[0]].normal, Vec3{half, 0, half}, 1e-6));
}

TEST_CASE("a teapot that lost its normals and its shared vertices looks like the teapot") {
    const Mesh original = built(*instance<Shape>("teapot"));
    const Mesh read = mesh_of(write_file(scratch_directory() / "teapot.obj", soup_of(original)));
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
        CHECK(agree(length(du), 2 * std::acos(-1.0), 2e-3));
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
