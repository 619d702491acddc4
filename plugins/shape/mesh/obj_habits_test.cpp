// OBJ files that many programs write although they do not quite follow the format.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"
#include "support/text.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;
using Catch::Matchers::ContainsSubstring;

namespace {

constexpr const char* k_square = "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\n";

candela::PlacedShape placed(const std::string& text, const std::string& part = "",
                            const char* name = "a.obj") {
    const auto file = write_file(scratch_directory() / name, text);
    return candela::place(*instance<Shape>("mesh", {{"file", file.string()}, {"part", part}}), {.uv = true},
                          {});
}

std::string refusal_of(const std::string& text, const char* name = "a.obj") {
    return message_of([&] { placed(text, "", name); });
}

}  // namespace

TEST_CASE("shape/mesh: a byte order mark at the head of a text is skipped, and UTF-16 is named") {
    const std::string mark = "\xef\xbb\xbf";
    // Without its first statement, the indices would be one off.
    const candela::PlacedShape obj = placed(mark + k_square + "f 1 2 3 4\n");
    CHECK(obj.warnings.empty());
    CHECK(obj.mesh.triangle_count() == 2);
    CHECK(obj.mesh.position.span()[0] == Vec3{-1, -1, 0});
    CHECK(placed(mark + "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex 0 1 0\n"
                        "endloop\nendfacet\nendsolid a\n",
                 "", "a.stl")
              .mesh.triangle_count() == 1);
    CHECK(placed(mark +
                     "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
                     "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                     "0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                 "", "a.ply")
              .mesh.triangle_count() == 1);
    CHECK(placed(mark + R"({"asset": {"version": "2.0"}, "nodes": [{"mesh": 0}],
"meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
"accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}],
"bufferViews": [{"buffer": 0, "byteLength": 36}], "buffers": [{"byteLength": 36, "uri":
"data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]})",
                 "", "a.gltf")
              .mesh.triangle_count() == 1);
    for (const char* const name : {"a.obj", "a.ply", "a.stl", "a.gltf"}) {
        INFO(name);
        CHECK_THAT(refusal_of(std::string("\xff\xfev\0 \0", 6) + k_square, name),
                   ContainsSubstring("is UTF-16 text"));
    }
}

TEST_CASE("shape/mesh: a Git LFS pointer in place of a file is named") {
    for (const char* const name : {"a.obj", "a.ply", "a.stl", "a.gltf", "a.glb"}) {
        INFO(name);
        CHECK_THAT(
            refusal_of("version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 123456\n", name),
            ContainsSubstring("is a Git LFS pointer") && ContainsSubstring("git lfs pull"));
    }
}

TEST_CASE("shape/mesh: normals and texture coordinates that are not finite are left out and counted") {
    for (const char* const word :
         {"nan", "-nan", "nan(ind)", "-nan(ind)", "-1.#IND", "1.#INF", "1.#QNAN0", "inf", "-inf", "1e999"}) {
        INFO(word);
        const candela::PlacedShape square = placed(fmt::format(
            "{0}vn 0 0 1\nvn {1} 0 0\nvn 0 {1} 0\nvt 1 0\nvt 0.5 {1}\nf 1/1/1 2/1/2 3/1/3 4/2/1\n", k_square,
            word));
        CHECK(square.mesh.triangle_count() == 2);
        REQUIRE(square.warnings.size() == 2);
        CHECK_THAT(square.warnings[0],
                   ContainsSubstring("has 2 normals that are not finite; computed ones are used instead"));
        CHECK_THAT(square.warnings[1], ContainsSubstring("has 1 pair of texture coordinates"));
        const auto file =
            write_file(scratch_directory() / "b.obj",
                       fmt::format("{}vn 0 0 1\nvn {} 0 0\nf 1//1 2//2 3//1\n", k_square, word));
        const Mesh mesh = candela::build_mesh(*instance<Shape>("mesh", {{"file", file.string()}}), {}, {},
                                              *instance<candela::ShadingModel>("phong"));
        for (const std::uint32_t corner : mesh.indices)
            CHECK(agree(mesh.vertices[corner].normal, Vec3{0, 0, 1}, 1e-6));
    }
}

TEST_CASE("shape/mesh: only non-finite positions are refused, and the first is named") {
    for (const char* const word : {"nan", "-1.#IND", "1.#INF", "-inf"}) {
        INFO(word);
        CHECK_THAT(refusal_of(std::string("v 0 0 0\nv 1 ") + word + " 0\nv 0 1 inf\nf 1 2 3\n"),
                   ContainsSubstring("line 2: '" + std::string(word) + "' is not a finite number"));
    }
    CHECK_THAT(refusal_of("v 0 0 0\nv 1 0 zero\nv 0 1 0\nf 1 2 3\n"),
               ContainsSubstring("line 2: 'zero' is not a number"));
}

TEST_CASE("shape/mesh: a face stays although the normals and texture coordinates that it names are missing") {
    for (const char* const corners :
         {"f 1/1 2/2 3/3 4/4\n", "f 1//1 2//1 3//1 4//1\n", "f 1/9/9 2/9/9 3/9/9 4/9/9\n",
          "f 1/0/0 2/0/0 3/0/0 4/0/0\n", "f 1/-1/-1 2/-1/-1 3/-1/-1 4/-1/-1\n"}) {
        INFO(corners);
        const candela::PlacedShape square = placed(std::string(k_square) + corners);
        CHECK(square.mesh.triangle_count() == 2);
        CHECK(square.mesh.u.empty());
        REQUIRE_FALSE(square.warnings.empty());
        CHECK_THAT(square.warnings[0], ContainsSubstring("has 4 corners with"));
    }
    // Existing ones are used.
    const candela::PlacedShape some = placed(std::string(k_square) + "vt 0.5 0.25\nf 1/1 2/2 3/1 4/1\n");
    REQUIRE(some.warnings.size() == 1);
    CHECK_THAT(some.warnings[0],
               ContainsSubstring("has 1 corner with texture coordinates that it does not contain"));
    CHECK(std::ranges::count(some.mesh.u, 0.5f) == 3);
    CHECK_THAT(refusal_of(std::string(k_square) + "f 1 2 9\n"),
               ContainsSubstring("line 5: vertex 9 of a face is out of range; there are only 4 vertices"));
}

TEST_CASE("shape/mesh: a file without faces is refused with a list of its contents") {
    CHECK_THAT(refusal_of("v 0 0 0\nv 1 0 0\nl 1 2\n"),
               ContainsSubstring("has 1 line and no triangles; Candela draws surfaces"));
    CHECK_THAT(refusal_of("v 0 0 0\nv 1 0 0\nl 1 2\nl 2 1\np 1 2\n"),
               ContainsSubstring("has 2 lines and 1 set of points and no triangles"));
    CHECK_THAT(refusal_of("v 0 0 0\nv 1 0 0\n"), ContainsSubstring("has 2 vertices and no faces"));
    CHECK_THAT(
        refusal_of(std::string(k_square) +
                   "cstype bspline\ndeg 1 1\nsurf 0 1 0 1 1 2 4 3\nparm u 0 0 1 1\nparm v 0 0 1 1\nend\n"),
        ContainsSubstring("has free-form surfaces only"));
    CHECK_THAT(refusal_of("v 0 0 0\nv 1 1 0\ncstype bezier\ndeg 1\ncurv 0 1 1 2\nparm u 0 1\nend\n"),
               ContainsSubstring("has free-form curves only"));
}

TEST_CASE("shape/mesh: a material's name extends to the end of its line") {
    const std::string text = std::string(k_square) +
                             "usemtl Paint #1\nf 1 2 3\nusemtl Paint #2 \t\nf 1 3 4\nusemtl wood\\\nf 1 2 4\n"
                             "usemtl a\t b\nf 2 3 4\nf 2 3 1\n";
    CHECK(placed(text, "Paint #1").mesh.triangle_count() == 1);
    CHECK(placed(text, "Paint #2").mesh.triangle_count() == 1);
    CHECK(placed(text, "wood\\").mesh.triangle_count() == 1);
    CHECK(placed(text, "a b").mesh.triangle_count() == 2);
    // A scene may name it without the comment.
    CHECK(placed(std::string(k_square) + "usemtl red # the door\nf 1 2 3\n", "red").mesh.triangle_count() ==
          1);
}
