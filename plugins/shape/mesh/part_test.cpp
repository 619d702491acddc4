#include <catch2/catch_test_macros.hpp>
#include <stdexcept>
#include <string>

#include "support/command.h"
#include "support/plugins.h"
#include "support/text.h"

using candela::Mesh;
using candela::Shape;

namespace {

/// A tetrahedron: two faces of `red`, one of `blue`, one before any material.
constexpr const char* k_obj =
    "mtllib no.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nusemtl red\nf 1 2 4\nusemtl deep  blue # or "
    "so\n"
    "f 1 4 3\nusemtl red\nf 2 3 4\n";

Mesh part_of(const std::string& name, const std::string& text, const std::string& part) {
    const auto file = write_file(scratch_directory() / name, text);
    return candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}, {"part", part}}), {}, {},
                               *instance<candela::ShadingModel>("phong"));
}

std::string refusal_of(const std::string& name, const std::string& text, const std::string& part) {
    return message_of([&] { part_of(name, text, part); });
}

}  // namespace

TEST_CASE("shape/mesh: a part is the triangles of one material, with the vertices that they use") {
    const Mesh red = part_of("a.obj", k_obj, "red");
    CHECK(red.triangle_count() == 2);
    CHECK(red.open_edges == 4);
    const Mesh blue = part_of("a.obj", k_obj, "deep blue");
    REQUIRE(blue.triangle_count() == 1);
    CHECK(blue.vertex_count() == 3);
    // Its face, x = 0, points in the same direction as in the whole.
    CHECK(blue.face_normal.span()[0] == candela::Vec3{-1, 0, 0});
    CHECK(part_of("a.obj", k_obj, "(none)").triangle_count() == 1);
    CHECK(part_of("a.obj", k_obj, "").triangle_count() == 4);
}

TEST_CASE("shape/mesh: a part of a mesh that is wound inside out is turned round with the whole") {
    const Mesh blue = part_of("a.obj",
                              "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nf 1 4 2\nusemtl blue\nf 1 3 4\n"
                              "usemtl red\nf 2 4 3\n",
                              "blue");
    REQUIRE(blue.triangle_count() == 1);
    CHECK(blue.face_normal.span()[0] == candela::Vec3{-1, 0, 0});
}

TEST_CASE("shape/mesh: polygons and colours stay with their part") {
    const Mesh part =
        part_of("a.obj",
                "v 0 0 0 1 0 0\nv 1 0 0 1 0 0\nv 1 1 0 1 0 0\nv 0 1 0 1 0 0\nv 2 0 0 0 1 0\nv 2 1 0 0 1 0\n"
                "usemtl a\nf 1 2 3 4\nf 1 2\nusemtl b\nf 2 5 6 3\n",
                "b");
    CHECK(part.triangle_count() == 2);
    CHECK(part.vertex_count() == 4);
}

TEST_CASE("shape/mesh: a missing part is refused with the names of the existing ones") {
    CHECK(refusal_of("a.obj", k_obj, "green")
              .ends_with("has no triangles with a material 'green'; its materials: '(none)', 'red' and 'deep "
                         "blue # or so'"));
    CHECK(holds(refusal_of("a.obj", k_obj, "#9"), "has no triangles with a material '#9'"));
    CHECK(refusal_of(
              "a.stl",
              "solid b\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 7\nendloop\n"
              "endfacet\nendsolid b\n",
              "x")
              .ends_with("has no materials, and so no part 'x'"));
}
