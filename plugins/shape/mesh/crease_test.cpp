// Hard and smooth edges of meshes whose files have no normals.
#include <fmt/format.h>

#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <string>

#include "read_mesh.h"
#include "support/command.h"
#include "support/samples.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

/// Two squares that meet along the z axis, the first in the plane y = 0, the second turned up by `degrees`.
std::string fold(double degrees) {
    const double turn = degrees * std::acos(-1.0) / 180;
    return fmt::format(
        "v 0 0 0\nv 0 0 1\nv -1 0 1\nv -1 0 0\nv {0} {1} 0\nv {0} {1} 1\nf 1 4 3 2\nf 1 2 6 5\n",
        std::cos(turn), std::sin(turn));
}

}  // namespace

TEST_CASE("shape/mesh: without normals, edges are hard where faces turn by more than the crease angle") {
    // A fold by d degrees turns the normals by d.
    for (const double degrees : {10.0, 39.0, 41.0, 90.0, 135.0}) {
        INFO(degrees);
        CHECK(has_hard_edge(mesh_of_text("fold.obj", fold(degrees))) == (degrees > 40));
        CHECK(has_hard_edge(mesh_of_text("fold.obj", fold(degrees), degrees - 0.5)));
        CHECK_FALSE(has_hard_edge(mesh_of_text("fold.obj", fold(degrees), degrees + 0.5)));
        CHECK_FALSE(has_hard_edge(mesh_of_text("fold.obj", fold(degrees), 180)));
    }
    // Where it is smooth, the edge's normals lie between those of the squares.
    const Mesh mesh = mesh_of_text("fold.obj", fold(30));
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const Vec3 p = mesh.position.span()[mesh.indices[corner]];
        if (p.x != 0) continue;
        const Double3 n = exact(normal_of_corner(mesh, corner));
        const double turned = std::atan2(-n.x, n.y) * 180 / std::acos(-1.0);
        CHECK(agree(n.z, 0, 1e-6, 1e-6));
        CHECK(turned > 9.9);
        CHECK(turned < 20.1);
    }
}

TEST_CASE(
    "shape/mesh: without a request for normals, the file's vertices stay as they are, without duplicates") {
    const auto file = write_file(scratch_directory() / "fold.obj", fold(90));
    const auto shape = instance<Shape>("mesh", {{"file", file.string()}});
    const candela::Mesh with = candela::place(*shape, {}, {}).mesh;
    const candela::Mesh without = candela::place(*shape, {.normals = false}, {}).mesh;
    CHECK(with.vertex_count() == 8);
    CHECK(without.vertex_count() == 6);
    CHECK(without.triangle_count() == with.triangle_count());
    CHECK(without.open_edges == with.open_edges);
}

TEST_CASE("shape/mesh: hard edges apply to every shading model that has vertex normals") {
    for (const char* const shading :
         {"gouraud", "phong", "angle-weighted", "area-weighted", "max-weighted"}) {
        INFO(shading);
        CHECK(has_hard_edge(mesh_of_text("fold.obj", fold(90), 40, shading)));
        CHECK_FALSE(has_hard_edge(mesh_of_text("fold.obj", fold(90), 180, shading)));
    }
}

TEST_CASE("shape/mesh: a file's smoothing groups override the crease angle") {
    const std::string text = fold(90);
    const std::size_t second = text.rfind("f ");
    const auto grouped = [&](const char* first, const char* then) {
        return text.substr(0, text.find("f ")) + first +
               text.substr(text.find("f "), second - text.find("f ")) + then + text.substr(second);
    };
    for (const double crease_angle : {0.0, 40.0, 180.0}) {
        INFO(crease_angle);
        CHECK_FALSE(has_hard_edge(mesh_of_text("s.obj", grouped("s 1\n", ""), crease_angle)));
        CHECK(has_hard_edge(mesh_of_text("s.obj", grouped("s 1\n", "s 2\n"), crease_angle)));
        CHECK(has_hard_edge(mesh_of_text("s.obj", grouped("s off\n", ""), crease_angle)));
        CHECK(has_hard_edge(mesh_of_text("s.obj", grouped("s 0\n", ""), crease_angle)));
        CHECK(has_hard_edge(mesh_of_text("s.obj", grouped("s 1\n", "s off\n"), crease_angle)));
    }
}

TEST_CASE("shape/mesh: a cylinder without normals is smooth around, and sharp at its rims") {
    constexpr int k_sides = 24;  // 15 degrees from one to the next
    std::string text;
    std::string top = "f", bottom;
    for (int i = 0; i < k_sides; ++i) {
        const double phi = 2 * std::acos(-1.0) * i / k_sides;
        for (const int y : {0, 1})
            text += fmt::format("v {:.9} {} {:.9}\n", std::cos(phi), y, -std::sin(phi));
        top += fmt::format(" {}", 2 * i + 2);
        bottom = fmt::format(" {}", 2 * i + 1) + bottom;
    }
    text += top + "\nf" + bottom + "\n";
    for (int i = 0; i < k_sides; ++i) {
        const int a = 2 * i + 1, b = 2 * ((i + 1) % k_sides) + 1;
        text += fmt::format("f {} {} {} {}\n", a, b, b + 1, a + 1);
    }
    const Mesh mesh = mesh_of_text("cylinder.obj", text);
    CHECK(mesh.closed);
    for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
        const Vec3 p = mesh.position.span()[mesh.indices[corner]];
        const bool on_side = std::abs(mesh.face_normal.span()[corner / 3].y) < 0.5f;
        const Vec3 expected = on_side ? Vec3{p.x, 0, p.z} : mesh.face_normal.span()[corner / 3];
        // Two triangles of one side and one of the other lean the mean by a sixth of 15 degrees.
        CHECK(dot(normal_of_corner(mesh, corner), expected) > (on_side ? 0.998f : 0.99999f));
    }
}

TEST_CASE("shape/mesh: the crease angle also applies where hundreds of triangles meet") {
    // A cone of 400 sides: smooth around the tip. Its foot: hard.
    constexpr int k_sides = 400;
    std::string text = "v 0 1 0\nv 0 0 0\n";
    for (int i = 0; i < k_sides; ++i) {
        const double phi = 2 * std::acos(-1.0) * i / k_sides;
        text += fmt::format("v {:.9} 0 {:.9}\n", std::cos(phi), -std::sin(phi));
    }
    for (int i = 0; i < k_sides; ++i) {
        const int a = i + 3, b = (i + 1) % k_sides + 3;
        text += fmt::format("f 1 {} {}\nf 2 {} {}\n", a, b, b, a);
    }
    const Mesh mesh = mesh_of_text("cone.obj", text);
    CHECK(mesh.closed);
    CHECK(mesh.vertex_count() == 2 + 2 * k_sides);
    for (std::size_t corner = 0; corner < mesh.indices.size(); corner += 6)
        CHECK(agree(normal_of_corner(mesh, corner), Vec3{0, 1, 0}, 1e-4, 1e-4));
}
