// PLY and STL files as many programs write them: colours of any range, textures per corner, numbers that are
// not finite.
#include <algorithm>
#include <array>
#include <bit>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <cstdint>
#include <string>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"
#include "support/text.h"

using candela::Shape;
using candela::Vec3;
using Catch::Approx;
using Catch::Matchers::ContainsSubstring;

namespace {

candela::PlacedShape placed(const std::string& text, const char* name = "a.ply") {
    const auto file = write_file(scratch_directory() / name, text);
    return candela::place(*instance<Shape>("mesh", {{"file", file.string()}}),
                          {.uv = true, .color = true, .color_management = candela::ColorEncoding::none}, {});
}

std::string refusal_of(const std::string& text, const char* name = "a.ply") {
    return message_of([&] { placed(text, name); });
}

std::string warnings_of(const candela::PlacedShape& shape) {
    std::string all;
    for (const std::string& warning : shape.warnings) all += warning + "\n";
    return all;
}

/// A triangle whose vertices have these further properties.
std::string triangle(const std::string& properties, const std::array<std::string, 3>& values,
                     const std::string& of_face = "", const std::string& of_the_face = "") {
    return "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n" +
           properties + "element face 1\nproperty list uchar int vertex_indices\n" + of_face +
           "end_header\n0 0 0 " + values[0] + "\n1 0 0 " + values[1] + "\n0 1 0 " + values[2] + "\n3 0 1 2 " +
           of_the_face + "\n";
}

std::string colors(const std::string& type) {
    std::string text;
    for (const char* const name : {"red", "green", "blue"}) text += "property " + type + " " + name + "\n";
    return text;
}

template <class T>
void put(std::string& bytes, T value) {
    const auto raw = std::bit_cast<std::array<char, sizeof(T)>>(value);
    bytes.append(raw.data(), raw.size());
}

/// Two facets of a square, with these attributes.
std::string stl(std::string header, std::array<std::uint16_t, 2> attributes, float normal = 1) {
    header.resize(80, ' ');
    put(header, std::uint32_t{2});
    constexpr float k_corners[2][9] = {{0, 0, 0, 1, 0, 0, 1, 1, 0}, {0, 0, 0, 1, 1, 0, 0, 1, 0}};
    for (std::size_t t = 0; t < 2; ++t) {
        for (const float x : {0.0f, 0.0f, normal}) put(header, x);
        for (const float x : k_corners[t]) put(header, x);
        put(header, attributes[t]);
    }
    return header;
}

/// A row of this many squares, two facets each; the last two facets have these attributes.
std::string long_stl(std::string header, std::uint32_t squares, std::uint16_t last) {
    header.resize(80, ' ');
    put(header, 2 * squares);
    for (std::uint32_t i = 0; i < squares; ++i) {
        const auto x = static_cast<float>(i);
        const float corners[2][9] = {{x, 0, 0, x + 1, 0, 0, x + 1, 1, 0}, {x, 0, 0, x + 1, 1, 0, x, 1, 0}};
        for (const auto& facet : corners) {
            for (const float n : {0.0f, 0.0f, 1.0f}) put(header, n);
            for (const float c : facet) put(header, c);
            put(header, i + 1 == squares ? last : std::uint16_t{0});
        }
    }
    return header;
}

}  // namespace

TEST_CASE("shape/mesh: the range of a PLY file's colours follows from their values, whatever their type") {
    const std::array<std::string, 3> bytes = {"255 0 51", "0 255 0", "0 0 255"};
    for (const char* const type : {"int", "uint", "ushort", "short", "float", "double"}) {
        INFO(type);
        const candela::PlacedShape shape = placed(triangle(colors(type), bytes));
        CHECK(shape.mesh.color.span()[0].x == 1);
        CHECK(shape.mesh.color.span()[0].z == Approx(0.2));
        CHECK_THAT(warnings_of(shape), ContainsSubstring(std::string("has vertex colours of type ") + type +
                                                         " up to 255, which are interpreted as 0 to 255"));
    }
    for (const auto& [type, values] :
         {std::pair{"uchar", bytes},
          {"ushort", std::array<std::string, 3>{"65535 0 13107", "0 0 0", "0 0 0"}},
          {"float", std::array<std::string, 3>{"1 0 0.2", "0 0 0", "0 0 0"}}}) {
        INFO(type);
        const candela::PlacedShape shape = placed(triangle(colors(type), values));
        CHECK(shape.mesh.color.span()[0].x == 1);
        CHECK(shape.mesh.color.span()[0].z == Approx(0.2));
        CHECK(shape.warnings.empty());
    }
    // Slightly above white is bright light, not another range.
    CHECK(placed(triangle(colors("float"), {"2 0 0.5", "0 0 0", "0 0 0"})).mesh.color.span()[0].z == 0.5f);
}

TEST_CASE("shape/mesh: colours of a PLY file's faces are those of their corners") {
    const std::string text =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 3\nproperty list uchar int vertex_indices\n" +
        colors("uchar") +
        "end_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n2 0 1 9 9 9\n3 0 1 2 255 0 0\n3 0 2 3 0 0 255\n";
    const candela::PlacedShape shape = placed(text);
    REQUIRE(shape.mesh.triangle_count() == 2);
    for (std::size_t i = 0; i < 6; ++i) {
        const Vec3 color = shape.mesh.color.span()[shape.mesh.indices[i]];
        CHECK(color == (i < 3 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}));
    }
    INFO("where colours change, the surface stays smooth");
    CHECK(shape.smooth_group[shape.mesh.indices[0]] == shape.smooth_group[shape.mesh.indices[3]]);
}

TEST_CASE("shape/mesh: texture coordinates of a PLY file's faces are those of their corners") {
    const std::string list = "property list uchar float texcoord\nproperty int texnumber\n";
    const candela::PlacedShape shape = placed(triangle("", {"", "", ""}, list, "6 0 0.25 1 0.5 0.75 1 0"));
    REQUIRE(shape.mesh.u.size() == 3);
    const auto uv = [&](std::size_t corner) {
        const std::uint32_t i = shape.mesh.indices[corner];
        return std::pair(shape.mesh.u[i], shape.mesh.v[i]);
    };
    CHECK(uv(0) == std::pair(0.0f, 0.25f));
    CHECK(uv(1) == std::pair(1.0f, 0.5f));
    CHECK(uv(2) == std::pair(0.75f, 1.0f));
    CHECK(shape.warnings.empty());
    CHECK_THAT(warnings_of(placed(triangle("", {"", "", ""}, list, "4 0 0 1 1 1"))),
               ContainsSubstring("1 face without a pair of texture coordinates for each corner"));
}

TEST_CASE("shape/mesh: PLY and STL files with non-finite normals or texture coordinates are accepted") {
    const std::string normals =
        "property float nx\nproperty float ny\nproperty float nz\nproperty float s\nproperty float t\n";
    const candela::PlacedShape shape = placed(triangle(normals, {"nan 0 1 0 0", "0 0 1 inf 0", "0 0 1 1 1"}));
    CHECK_THAT(warnings_of(shape), ContainsSubstring("has 1 normal that is not finite; computed ones are"));
    CHECK_THAT(warnings_of(shape),
               ContainsSubstring("has 1 pair of texture coordinates that are not finite"));
    CHECK(std::ranges::all_of(shape.mesh.u, [](float u) { return std::isfinite(u); }));
    const candela::PlacedShape facets = placed(stl("", {0, 0}, std::bit_cast<float>(0x7fc00000u)), "a.stl");
    CHECK_THAT(warnings_of(facets), ContainsSubstring("2 normals that are not finite"));
}

TEST_CASE("shape/mesh: PLY and STL: a non-finite position is named, unless no triangle uses it") {
    std::string broken = triangle("", {"", "", ""});
    broken.replace(broken.find("1 0 0"), 5, "1 nan 0");
    CHECK_THAT(refusal_of(broken),
               ContainsSubstring("a face with the corner [1, nan, 0] (vertex 1, counted from 0)"));
    const std::string unused =
        "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\nnan nan nan\n0 0 0\n1 0 0\n0 1 "
        "0\n3 1 2 3\n";
    CHECK(placed(unused).mesh.triangle_count() == 1);
}

TEST_CASE("shape/mesh: the colours of Materialise Magics in an STL file are those of the mesh") {
    const std::string header("COLOR=\xff\0\0\xff,MATERIAL=", 20);
    const candela::PlacedShape red = placed(stl(header, {0, 0}), "a.stl");
    REQUIRE_FALSE(red.mesh.color.empty());
    for (std::size_t i = 0; i < red.mesh.vertex_count(); ++i)
        CHECK(red.mesh.color.span()[i] == Vec3{1, 0, 0});
    CHECK(red.warnings.empty());
    // The second facet is blue; the first has the object's colour.
    const candela::PlacedShape two = placed(stl(header, {0x8000, 0x7c00}), "b.stl");
    for (std::size_t i = 0; i < 6; ++i)
        CHECK(two.mesh.color.span()[two.mesh.indices[i]] == (i < 3 ? Vec3{1, 0, 0} : Vec3{0, 0, 1}));
    CHECK_THAT(warnings_of(placed(stl("", {0x801f, 0x801f}), "c.stl")),
               ContainsSubstring("attributes of facets"));
}

TEST_CASE("shape/mesh: a binary STL file longer than one read yields the same mesh") {
    constexpr std::uint32_t k_squares = 9001;  // 18,002 facets
    const candela::PlacedShape plain = placed(long_stl("", k_squares, 0), "long.stl");
    CHECK(plain.warnings.empty());
    REQUIRE(plain.mesh.triangle_count() == 2 * k_squares);
    CHECK(plain.mesh.vertex_count() == 2 * (k_squares + 1));
    bool are_all_there = true;
    for (std::uint32_t t = 0; t < 2 * k_squares; ++t) {
        const auto x = static_cast<float>(t / 2);
        const std::array<Vec3, 3> corners =
            t % 2 == 0 ? std::array{Vec3{x, 0, 0}, Vec3{x + 1, 0, 0}, Vec3{x + 1, 1, 0}}
                       : std::array{Vec3{x, 0, 0}, Vec3{x + 1, 1, 0}, Vec3{x, 1, 0}};
        for (std::size_t k = 0; k < 3; ++k)
            are_all_there =
                are_all_there && plain.mesh.position.span()[plain.mesh.indices[3 * t + k]] == corners[k];
    }
    CHECK(are_all_there);
    const candela::PlacedShape colored =
        placed(long_stl(std::string("COLOR=\xff\0\0\xff", 10), k_squares, 0x7c00), "colored.stl");
    const auto color_of = [&](std::size_t corner) {
        return colored.mesh.color.span()[colored.mesh.indices[corner]];
    };
    CHECK(color_of(3 * (2 * k_squares - 3)) == Vec3{0, 0, 0});
    CHECK(color_of(3 * (2 * k_squares - 1)) == Vec3{0, 0, 1});
}

TEST_CASE("shape/mesh: a PLY file with only points or lines is refused as such") {
    const std::string points =
        "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
    CHECK_THAT(refusal_of(points + "end_header\n0 0 0\n1 1 1\n"),
               ContainsSubstring("has 1 set of points (2) and no triangles; Candela draws surfaces"));
    CHECK_THAT(
        refusal_of(points +
                   "element face 0\nproperty list uchar int vertex_indices\nend_header\n0 0 0\n1 1 1\n"),
        ContainsSubstring("has 1 set of points (2) and no triangles"));
    CHECK_THAT(
        refusal_of(
            points +
            "element edge 1\nproperty int vertex1\nproperty int vertex2\nend_header\n0 0 0\n1 1 1\n0 1\n"),
        ContainsSubstring("has 1 line and no triangles; Candela draws surfaces"));
}
