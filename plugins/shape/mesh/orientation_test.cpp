// Closed parts of a mesh that are wound inside out.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "read_mesh.h"
#include "support/text.h"

using candela::Mesh;

namespace {

/// A tetrahedron around `x`; numbered from `first` on.
std::string tetrahedron(double x, double size, int first, bool inside_out) {
    std::string text;
    for (const auto& [a, b, c] :
         {std::array{1, 1, 1}, std::array{-1, -1, 1}, std::array{-1, 1, -1}, std::array{1, -1, -1}})
        text += fmt::format("v {} {} {}\n", x + size * a, size * b, size * c);
    for (auto [a, b, c] :
         {std::array{1, 2, 4}, std::array{1, 3, 2}, std::array{1, 4, 3}, std::array{4, 2, 3}}) {
        if (inside_out) std::swap(b, c);
        text += fmt::format("f {} {} {}\n", first + a, first + b, first + c);
    }
    return text;
}

/// Six times the volume that each group of four triangles encloses.
std::vector<double> volumes_of_four(const Mesh& mesh) {
    std::vector<double> volumes(mesh.triangle_count() / 4);
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const auto at = [&](std::size_t k) { return mesh.position.span()[mesh.indices[3 * t + k]]; };
        volumes[t / 4] += static_cast<double>(dot(at(0), cross(at(1), at(2))));
    }
    return volumes;
}

}  // namespace

TEST_CASE(
    "shape/mesh: a closed mesh that is wound inside out is turned round, normals included, with a warning") {
    // A tetrahedron, seen from within.
    const std::string corners = "v 1 1 1\nv -1 -1 1\nv -1 1 -1\nv 1 -1 -1\n";
    const std::string faces = "f 2 1 4\nf 2 3 1\nf 3 4 1\nf 3 2 4\n";
    const auto said = warnings_about("t.obj", corners + faces);
    REQUIRE(said.size() == 1);
    CHECK(said[0].ends_with("is closed but wound inside out, so its triangles are turned round"));
    const Mesh mesh = mesh_of_text("t.obj", corners + faces);
    CHECK(mesh.closed);
    for (std::size_t t = 0; t < 4; ++t)
        CHECK(dot(mesh.face_normal.span()[t], mesh.position.span()[mesh.indices[3 * t]]) > 0);
    // Half a tetrahedron has no inside.
    CHECK(warnings_about("h.obj", corners + "f 2 1 4\n").empty());

    std::string with_normals = corners + "vn -1 -1 -1\nvn 1 1 -1\nvn 1 -1 1\nvn -1 1 1\n";
    with_normals += "f 2//2 1//1 4//4\nf 2//2 3//3 1//1\nf 3//3 4//4 1//1\nf 3//3 2//2 4//4\n";
    const Mesh turned = mesh_of_text("n.obj", with_normals);
    for (std::size_t corner = 0; corner < 12; ++corner)
        CHECK(dot(normal_of_corner(turned, corner), turned.position.span()[turned.indices[corner]]) > 0);
    // Normals that were right stay as they are.
    std::string right = corners + "vn 1 1 1\nvn -1 -1 1\nvn -1 1 -1\nvn 1 -1 -1\n";
    right += "f 2//2 1//1 4//4\nf 2//2 3//3 1//1\nf 3//3 4//4 1//1\nf 3//3 2//2 4//4\n";
    const Mesh kept = mesh_of_text("r.obj", right);
    for (std::size_t corner = 0; corner < 12; ++corner)
        CHECK(dot(normal_of_corner(kept, corner), kept.position.span()[kept.indices[corner]]) > 0);
}

TEST_CASE("shape/mesh: of several parts, those that are wound inside out are turned round, and counted") {
    const std::string right = tetrahedron(0, 1, 0, false), wrong = tetrahedron(5, 1, 4, true);
    auto said = warnings_about("two.obj", right + wrong);
    REQUIRE(said.size() == 1);
    CHECK(said[0].ends_with(
        "has 2 parts, 1 of which is closed but wound inside out, so its triangles are turned round"));
    for (const double volume : volumes_of_four(mesh_of_text("two.obj", right + wrong))) CHECK(volume > 0);

    // However little they enclose compared with the others.
    const std::string large = tetrahedron(0, 10, 0, false), small = tetrahedron(50, 0.1, 4, true);
    CHECK(holds(warnings_about("small.obj", large + small + tetrahedron(60, 0.1, 8, true)).at(0),
                "has 3 parts, 2 of which are closed but wound inside out, so their triangles"));

    // With an open part next to it.
    const std::string open = tetrahedron(0, 1, 0, false).substr(0, right.rfind('f'));
    said = warnings_about("open.obj", open + wrong);
    REQUIRE(said.size() == 1);
    CHECK(holds(said[0], "has 2 parts, 1 of which is closed but wound"));
}

TEST_CASE("shape/mesh: a cavity keeps its winding, and turns with the part that contains it") {
    const std::string hollow = tetrahedron(0, 3, 0, false) + tetrahedron(0, 0.5, 4, true);
    CHECK(warnings_about("hollow.obj", hollow).empty());
    const auto volumes = volumes_of_four(mesh_of_text("hollow.obj", hollow));
    CHECK(volumes[0] > 0);
    CHECK(volumes[1] < 0);

    const std::string turned = tetrahedron(0, 3, 0, true) + tetrahedron(0, 0.5, 4, false);
    CHECK(warnings_about("turned.obj", turned).size() == 1);
    const auto after = volumes_of_four(mesh_of_text("turned.obj", turned));
    CHECK(after[0] > 0);
    CHECK(after[1] < 0);

    // A part that a ray passes through need not contain the part where the ray starts.
    std::string row;
    for (int i = 0; i < 200; ++i) row += tetrahedron(3.0 * i, 1, 4 * i, i % 3 == 0);
    CHECK(holds(warnings_about("row.obj", row).at(0), "has 200 parts, 67 of which are closed but wound"));
}
