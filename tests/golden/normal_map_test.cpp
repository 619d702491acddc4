// Normals from pictures, against lit squares computed by hand.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <string>

#include "golden/image.h"
#include "support/command.h"
#include "support/expect.h"
#include "support/gltf_square.h"

namespace {

using Vector = std::array<double, 3>;

constexpr int k_size = 8;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector unit(const Vector& v) {
    const double size = std::sqrt(dot(v, v));
    return {v[0] / size, v[1] / size, v[2] / size};
}

/// Towards the light of all scenes.
constexpr Vector k_to_light{0.48, 0.6, 0.64};

/// A texel's bytes, from column and row.
using Picture = std::function<std::array<int, 3>(int, int)>;

std::string ppm(const Picture& picture) {
    std::string text = fmt::format("P6\n{0} {0}\n255\n", k_size);
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x)
            for (const int value : picture(x, y)) text += static_cast<char>(value);
    }
    return text;
}

/// Different in every texel, and mostly upwards.
std::array<int, 3> some_normals(int x, int y) {
    return {128 + 13 * (x - 3), 130 + 11 * (y - 4), 220 - 3 * x};
}
Vector some_normal(int x, int y) {
    const std::array<int, 3> bytes = some_normals(x, y);
    Vector n{};
    for (std::size_t c = 0; c < 3; ++c) n[c] = 2 * bytes[c] / 255.0 - 1;
    return n;
}

/// A square of two metres in the plane z = 0 that faces the observer, one texel to a pixel; white Lambert
/// reflection, so that the intensity is N.L.
struct Square {
    std::string map;  // "normal_map = ..."
    std::string corners_uv = "vt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n";
    std::string more{};  // keys of the object
    Picture picture = some_normals;
    double observer_z = 4;
};

Image rendered(const Square& square, const std::string& file, const std::string& content) {
    const auto folder = scratch_directory();
    write_file(folder / file, content);
    write_file(folder / "p.ppm", ppm(square.picture));
    return render_floats(
        folder, fmt::format("[observer]\nposition = [0, 0, {0}]\nlook_at = [0, 0, 0]\nprojection = "
                            "\"orthographic\"\nheight = 2\n[image]\nwidth = {1}\nheight = {1}\n[shading]\n"
                            "model = \"phong\"\n[reflection]\nmodel = \"lambert\"\n[[light]]\ntype = "
                            "\"directional\"\ndirection = [-0.48, -0.6, {2}]\n[[object]]\ntype = \"mesh\"\n"
                            "file = \"{5}\"\nappearance_imported = true\ncolor = [255, 255, 255]\n{3}\n"
                            "{4}\n[object.material]\nka = 0\nkd = 1\n",
                            square.observer_z, k_size, square.observer_z > 0 ? -0.64 : 0.64, square.more,
                            square.map, file));
}

Image rendered(const Square& square) {
    return rendered(square, "square.obj",
                    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvn 0 0 1\n" + square.corners_uv +
                        "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n");
}

/// `normal`: of a pixel's column and row.
void require_lit(const Image& image, const std::function<Vector(int, int)>& normal,
                 const Vector& to_light = k_to_light) {
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x) {
            const double expected = std::max(0.0, dot(unit(normal(x, y)), to_light));
            INFO("pixel " << x << ", " << y << ": " << image.at(x, y).x << ", expected " << expected);
            REQUIRE(std::abs(static_cast<double>(image.at(x, y).x) - expected) < 3e-4);
        }
    }
}

constexpr const char* k_map = "normal_map = { texture = \"p.ppm\" }";

}  // namespace

TEST_CASE("golden: a normal map's red is along u, its green along v, its blue along the normal") {
    require_lit(rendered({.map = k_map}), some_normal);
    SECTION("and a scale makes it steeper") {
        require_lit(rendered({.map = "normal_map = { texture = \"p.ppm\", scale = 1.5 }"}), [](int x, int y) {
            const Vector n = some_normal(x, y);
            return Vector{1.5 * n[0], 1.5 * n[1], n[2]};
        });
    }
}

TEST_CASE("golden: a normal map is turned and mirrored with the texture coordinates") {
    // u is upwards, v to the left: the picture is a quarter turn counter-clockwise.
    require_lit(rendered({.map = k_map, .corners_uv = "vt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\n"}), [](int x, int y) {
        const Vector n = some_normal(k_size - 1 - y, x);
        return Vector{-n[1], n[0], n[2]};
    });
    SECTION("where u grows to the left, red is to the left") {
        require_lit(rendered({.map = k_map, .corners_uv = "vt 1 0\nvt 0 0\nvt 0 1\nvt 1 1\n"}),
                    [](int x, int y) {
                        const Vector n = some_normal(k_size - 1 - x, y);
                        return Vector{-n[0], n[1], n[2]};
                    });
    }
    SECTION("and by its transform") {
        // (u, v) becomes (-v, u): the picture's u is downwards, its v to the right.
        require_lit(rendered({.map = "normal_map = { texture = \"p.ppm\", transform = { rotation = 90 } }"}),
                    [](int x, int y) {
                        const Vector n = some_normal(y, k_size - 1 - x);
                        return Vector{n[1], -n[0], n[2]};
                    });
        require_lit(
            rendered({.map = "normal_map = { texture = \"p.ppm\", transform = { scale = [-1, 1] } }"}),
            [](int x, int y) {
                const Vector n = some_normal(k_size - 1 - x, y);
                return Vector{-n[0], n[1], n[2]};
            });
    }
}

TEST_CASE("golden: a normal map of a glTF file refers to the file's tangents") {
    // Not those of the texture coordinates, so that a mistake shows; mirrored with -1.
    for (const double side : {1.0, -1.0}) {
        GltfSquare square;
        std::vector<float> tangents;
        for (int i = 0; i < 4; ++i)
            tangents.insert(tangents.end(), {0.6f, 0.8f, 0, static_cast<float>(side)});
        square.primitive()["attributes"]["TANGENT"] = square.floats("VEC4", tangents);
        require_lit(rendered({.map = k_map}, "square.glb", square.glb()), [&](int x, int y) {
            const Vector n = some_normal(x, y);
            return Vector{0.6 * n[0] - side * 0.8 * n[1], 0.8 * n[0] + side * 0.6 * n[1], n[2]};
        });
    }
}

TEST_CASE("golden: from behind, an open surface's mapped normals are reversed") {
    // Seen from z = -4, the square's left is its right.
    const Image image = rendered({.map = k_map, .observer_z = -4});
    require_lit(image,
                [](int x, int y) {
                    const Vector n = some_normal(k_size - 1 - x, y);
                    return Vector{-n[0], -n[1], -n[2]};
                },
                {0.48, 0.6, -0.64});
}

TEST_CASE("golden: a bump map tilts normals by the slopes of its heights, in metres") {
    // Rises by 8 of 255 per texel to the right and 5 upwards; inside, slopes are those of the whole plane.
    const Picture ramp = [](int x, int y) {
        return std::array<int, 3>{40 + 8 * x + 5 * (k_size - 1 - y), 0, 0};
    };
    const auto inside = [](const Image& image, double along_x, double along_y) {
        for (int y = 1; y + 1 < k_size; ++y) {
            for (int x = 1; x + 1 < k_size; ++x) {
                const double expected = dot(unit(Vector{-along_x, -along_y, 1}), k_to_light);
                INFO("pixel " << x << ", " << y << ": " << image.at(x, y).x << ", expected " << expected);
                REQUIRE(std::abs(static_cast<double>(image.at(x, y).x) - expected) < 3e-4);
            }
        }
    };
    const double texel = 2.0 / k_size, height = 3;
    const double along_x = height * 8 / 255 / texel, along_y = height * 5 / 255 / texel;
    inside(rendered({.map = "bump_map = { texture = \"p.ppm\", height = 3 }", .picture = ramp}), along_x,
           along_y);
    SECTION("below the surface, if the height is negative") {
        inside(rendered({.map = "bump_map = { texture = \"p.ppm\", height = -3 }", .picture = ramp}),
               -along_x, -along_y);
    }
    SECTION("half as steep on a surface that is twice as large") {
        const std::string map =
            "bump_map = { texture = \"p.ppm\", height = 3, transform = { scale = [2, 2], "
            "offset = [-0.5, -0.5] } }";
        inside(rendered({.map = map, .more = "scale = 2", .picture = ramp}), along_x, along_y);
    }
    SECTION("whatever the texture coordinates, which may be mirrored and oblique") {
        // u = (1 - x) / 2, v = (y + x) / 2 + 1 / 2 on the square: the heights are functions of them.
        const double h_u = height * k_size * 8 / 255.0, h_v = height * k_size * 5 / 255.0;
        const Image image = rendered({.map = "bump_map = { texture = \"p.ppm\", height = 3 }",
                                      .corners_uv = "vt 1 -0.5\nvt 0 0.5\nvt 0 1.5\nvt 1 0.5\n",
                                      .picture = ramp});
        // Far from where the picture begins again.
        for (const auto& [x, y] : {std::pair(3, 4), std::pair(4, 3), std::pair(4, 4)}) {
            const double expected = dot(unit(Vector{h_u / 2 - h_v / 2, -h_v / 2, 1}), k_to_light);
            INFO("pixel " << x << ", " << y << ": " << image.at(x, y).x << ", expected " << expected);
            CHECK(std::abs(static_cast<double>(image.at(x, y).x) - expected) < 2e-3);
        }
    }
}

TEST_CASE("golden: a clamped bump map is level beyond its edges") {
    const Picture ramp = [](int x, int) { return std::array<int, 3>{30 * x, 0, 0}; };
    const Image image = rendered({.map = "bump_map = { texture = \"p.ppm\", height = 1, wrap = \"clamp\", "
                                         "transform = { offset = [1.5, 0] } }",
                                  .picture = ramp});
    // Half of the last slope is blended in at the last texel itself, which the edge continues.
    const double slope = 0.5 * 30 / 255 / (2.0 / k_size);
    require_lit(image, [&](int, int) { return Vector{-slope, 0, 1}; });
}
