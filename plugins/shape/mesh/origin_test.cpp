// Files whose coordinates lie far from their origin, such as surveys and maps.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>
#include <cmath>
#include <cstdint>
#include <string>

#include "support/command.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::Shape;
using candela::Vec3;

namespace {

using Point = std::array<double, 3>;

constexpr std::array<Point, 3> k_corners = {
    {{0.125, -0.25, 0.5}, {1.03125, 0.0625, 0.75}, {-0.5, 0.875, 0.03125}}};

std::string as_obj(const Point& at) {
    std::string text;
    for (const Point& p : k_corners)
        text += fmt::format("v {} {} {}\n", at[0] + p[0], at[1] + p[1], at[2] + p[2]);
    return text + "f 1 2 3\n";
}

std::string as_stl(const Point& at) {
    std::string text = "solid a\nfacet normal 0 0 0\nouter loop\n";
    for (const Point& p : k_corners)
        text += fmt::format("vertex {} {} {}\n", at[0] + p[0], at[1] + p[1], at[2] + p[2]);
    return text + "endloop\nendfacet\nendsolid a\n";
}

std::string ply_header(const char* encoding) {
    return fmt::format(
        "ply\nformat {} 1.0\nelement vertex 3\nproperty double x\nproperty double y\nproperty double z\n"
        "element face 1\nproperty list uchar int vertex_indices\nend_header\n",
        encoding);
}

std::string as_text_ply(const Point& at) {
    std::string text = ply_header("ascii");
    for (const Point& p : k_corners)
        text += fmt::format("{} {} {}\n", at[0] + p[0], at[1] + p[1], at[2] + p[2]);
    return text + "3 0 1 2\n";
}

std::string as_binary_ply(const Point& at) {
    std::string text = ply_header("binary_little_endian");
    for (const Point& p : k_corners)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto bits = std::bit_cast<std::uint64_t>(at[axis] + p[axis]);
            for (int shift = 0; shift < 64; shift += 8) text += static_cast<char>(bits >> shift & 0xff);
        }
    return text + std::string("\3\0\0\0\0\1\0\0\0\2\0\0\0", 13);
}

/// The distance is in its node, as programs write it.
std::string as_gltf(const Point& at) {
    return fmt::format(
        R"({{"asset": {{"version": "2.0"}}, "nodes": [{{"mesh": 0, "translation": [{}, {}, {}]}}],
"meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
"accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"}}],
"bufferViews": [{{"buffer": 0, "byteLength": 36}}], "buffers": [{{"byteLength": 36, "uri": "far.bin"}}]}})",
        at[0], at[1], at[2]);
}

/// The buffer of that file.
std::string corners_as_bytes() {
    std::string bytes;
    for (const Point& p : k_corners)
        for (const double x : p) {
            const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(x));
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
        }
    return bytes;
}

struct Format {
    const char* name;
    std::string (*text)(const Point&);
};

constexpr std::array<Format, 5> k_formats = {{{"far.obj", as_obj},
                                              {"far.stl", as_stl},
                                              {"far.ply", as_text_ply},
                                              {"far.ply", as_binary_ply},
                                              {"far.gltf", as_gltf}}};

candela::PlacedShape placed(const std::string& name, const std::string& text, const std::string& origin) {
    const auto file = write_file(scratch_directory() / name, text);
    write_file(file.parent_path() / "far.bin", corners_as_bytes());
    return candela::place(*instance<Shape>("mesh", {{"file", file.string()}, {"origin", origin}}), {}, {});
}

}  // namespace

TEST_CASE("shape/mesh: coordinates are moved before they are rounded, in every format") {
    for (const Point& at : {Point{500000, 4500000, 128}, Point{-4500000, 600000, 4400000}})
        for (const Format& format : k_formats) {
            INFO(format.name << " at " << at[0]);
            const candela::PlacedShape far =
                placed(format.name, format.text(at), fmt::format("{} {}, {}", at[0], at[1], at[2]));
            CHECK(far.warnings.empty());
            REQUIRE(far.mesh.vertex_count() == 3);
            for (std::size_t i = 0; i < 3; ++i) {
                const Point& p = k_corners[i];
                CHECK(far.mesh.position.span()[i] ==
                      Vec3{static_cast<float>(p[0]), static_cast<float>(p[1]), static_cast<float>(p[2])});
            }
        }
}

TEST_CASE("shape/mesh: an origin need not be representable in single precision") {
    const candela::PlacedShape far =
        placed("far.obj", as_obj({500000.25, 4500000.75, 120}), "500000.25 4500000.75 120");
    CHECK(far.mesh.position.span()[0] == Vec3{0.125f, -0.25f, 0.5f});
}

TEST_CASE("shape/mesh: visibly rounded coordinates cause a warning with the origin to set") {
    const candela::PlacedShape far = placed("far.obj", as_obj({500000, 4500000, 120}), "");
    REQUIRE(far.warnings.size() == 1);
    CHECK_THAT(far.warnings[0],
               Catch::Matchers::ContainsSubstring(
                   "its coordinates are rounded to 0.5 m; set origin = \"500000 4500001 120\""));
    CHECK(placed("far.obj", as_obj({100, 0, -100}), "").warnings.empty());
}

TEST_CASE("shape/mesh: an origin other than three finite numbers is refused with an example") {
    for (const char* const wrong : {"1 2", "1 2 3 4", "1 2 nan", "a b c", "1e999 0 0"}) {
        INFO(wrong);
        CHECK_THROWS_WITH(placed("far.obj", as_obj({0, 0, 0}), wrong),
                          Catch::Matchers::ContainsSubstring("expected three numbers"));
    }
}

TEST_CASE(
    "shape/mesh: coordinates rounded in the file itself cause a warning without an origin, which could not "
    "help") {
    std::string bytes(80, ' ');
    bytes += std::string("\1\0\0\0", 4) + std::string(12, '\0');
    for (const Point& p : k_corners)
        for (std::size_t axis = 0; axis < 3; ++axis) {
            const auto bits = std::bit_cast<std::uint32_t>(static_cast<float>(4500000 + p[axis]));
            for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xff);
        }
    bytes += std::string(2, '\0');
    const candela::PlacedShape far = placed("far.stl", bytes, "4500000 4500000 4500000");
    REQUIRE_FALSE(far.warnings.empty());
    CHECK_THAT(far.warnings[0],
               Catch::Matchers::ContainsSubstring(
                   "stores its coordinates in single precision, which rounds them to 0.5 m"));
}
