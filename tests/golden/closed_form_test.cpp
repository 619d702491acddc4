// Compares pictures with closed forms: figures that come from geometry and the equations, not from our own
// code.
#include <fmt/format.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>
#include <optional>
#include <set>
#include <tuple>

#include "golden/image.h"
#include "support/command.h"
#include "support/scene_tables.h"

namespace {

/// A view along -z from (0, 0, 4), without colour management, so that intensities need no decoding.
std::string orthographic_view(int size, double metres) {
    return fmt::format(
        "[observer]\nposition = [0, 0, 4]\nlook_at = [0, 0, 0]\nprojection = \"orthographic\"\nheight = {}\n"
        "[image]\nwidth = {}\nheight = {}\ncolor_management = \"none\"\n",
        metres, size, size);
}

std::string perspective_view(int width, int height, double fov) {
    return k_observer + fmt::format("fov = {}\n", fov) + image_table(width, height) +
           "color_management = \"none\"\n";
}

constexpr Double3 k_eye{0, 0, 4};

/// A triangle with a normal at each corner, as an OBJ file.
struct Triangle {
    std::array<Double3, 3> p;
    std::array<Double3, 3> n;

    std::string obj() const {
        std::string text;
        for (const Double3& v : p) text += fmt::format("v {} {} {}\n", v.x, v.y, v.z);
        for (const Double3& v : n) text += fmt::format("vn {} {} {}\n", v.x, v.y, v.z);
        return text + "f 1//1 2//2 3//3\n";
    }
};

/// Barycentric coordinates where a ray meets the triangle, by the areas of the sub-triangles; none if it
/// misses, or passes within `margin` (of a coordinate) of an edge.
std::optional<Double3> hit(const Triangle& t, Double3 origin, Double3 direction, double margin) {
    const Double3 n = cross(t.p[1] - t.p[0], t.p[2] - t.p[0]);
    const double along = dot(n, direction);
    if (along == 0) return std::nullopt;
    const Double3 point = origin + (dot(n, t.p[0] - origin) / along) * direction;
    const auto area = [&](int i, int j) { return dot(n, cross(t.p[i] - point, t.p[j] - point)) / dot(n, n); };
    const Double3 b{area(1, 2), area(2, 0), area(0, 1)};
    if (std::min({b.x, b.y, b.z}) < margin) return std::nullopt;
    return b;
}

Double3 mix(const std::array<Double3, 3>& v, Double3 b) { return b.x * v[0] + b.y * v[1] + b.z * v[2]; }

/// Compares all pixels for which `expected` has a value; returns their number.
int compare(const Image& image, double relative, double absolute,
            const std::function<std::optional<Double3>(int, int)>& expected) {
    int compared = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const auto value = expected(x, y);
            if (!value) continue;
            ++compared;
            INFO("pixel " << x << ", " << y << ": " << text(image.at(x, y)) << ", expected " << text(*value));
            REQUIRE(agree(image.at(x, y), *value, relative, absolute));
        }
    }
    return compared;
}

const Triangle k_triangle{{{{-1.2, -0.9, 0.4}, {1.3, -0.7, -0.6}, {0.1, 1.1, 0.9}}},
                          {{unit({-0.5, -0.4, 1}), unit({0.6, -0.3, 0.9}), unit({0.1, 0.7, 1.1})}}};

std::string mesh_object(const char* material) {
    return fmt::format(
        "[[object]]\ntype = \"mesh\"\nfile = \"triangle.obj\"\ncolor = [255, 204, "
        "102]\n[object.material]\n{}\n",
        material);
}
constexpr Double3 k_color{1, 0.8, 0.4};

}  // namespace

TEST_CASE("an orthographic Lambert sphere under a directional light is k_d max(N.L, 0) of the true sphere") {
    const Image image = render_floats(
        scratch_directory(),
        orthographic_view(256, 1.2) + models("phong", "lambert") +
            "[[light]]\ntype = \"directional\"\ndirection = [-1, -2, -2]\n"
            "[[object]]\ntype = \"sphere\"\nradius = 0.5\nsegments = 1024\ncolor = [255, 255, 255]\n"
            "[object.material]\nka = 0\nkd = 0.8\n");
    const Double3 light = unit({1, 2, 2});
    const int compared = compare(image, 0, 1e-3, [&](int x, int y) -> std::optional<Double3> {
        const Double3 p = orthographic_point(image, x, y, 1.2);
        const double r2 = p.x * p.x + p.y * p.y;
        if (r2 > 0.495 * 0.495) return std::nullopt;  // the silhouette itself is the mesh's
        const Double3 n = 2.0 * Double3{p.x, p.y, std::sqrt(0.25 - r2)};
        const double i = 0.8 * std::max(dot(n, light), 0.0);
        return Double3{i, i, i};
    });
    CHECK(compared > 30000);
}

TEST_CASE("a cube's face under a point light follows 1/r^2") {
    const Image image = render_floats(
        scratch_directory(), orthographic_view(200, 2) + models("phong", "lambert") +
                                 "[[light]]\ntype = \"point\"\nposition = [0.4, -0.3, 2.5]\nintensity = 3\n"
                                 "[[object]]\ntype = \"cube\"\nsize = 2\ncolor = [255, 255, 255]\n"
                                 "[object.material]\nka = 0\nkd = 1\n");
    const int compared = compare(image, 1e-4, 0, [&](int x, int y) -> std::optional<Double3> {
        Double3 p = orthographic_point(image, x, y, 2);
        p.z = 1;
        const Double3 d = Double3{0.4, -0.3, 2.5} - p;
        const double i = 3 * unit(d).z / dot(d, d);
        return Double3{i, i, i};
    });
    CHECK(compared == 200 * 200);
}

TEST_CASE("a Gouraud triangle is the barycentric mix of its vertices' colours, in both projections") {
    const auto directory = scratch_directory();
    write_file(directory / "triangle.obj", k_triangle.obj());
    const Double3 lamp{1, 1.5, 3};
    std::array<Double3, 3> at_vertex;
    for (std::size_t k = 0; k < 3; ++k) {
        const Double3 d = lamp - k_triangle.p[k];
        at_vertex[k] = 0.9 * 4 * std::max(dot(k_triangle.n[k], unit(d)), 0.0) / dot(d, d) * k_color;
    }
    const std::string rest = models("gouraud", "lambert") +
                             "[[light]]\ntype = \"point\"\nposition = [1, 1.5, 3]\nintensity = 4\n" +
                             mesh_object("ka = 0\nkd = 0.9");
    SECTION("orthographic") {
        const Image image = render_floats(directory, orthographic_view(160, 3) + rest);
        CHECK(compare(image, 1e-5, 1e-5, [&](int x, int y) -> std::optional<Double3> {
                  Double3 origin = orthographic_point(image, x, y, 3);
                  origin.z = 4;
                  const auto b = hit(k_triangle, origin, {0, 0, -1}, 0.01);
                  return b ? std::optional(mix(at_vertex, *b)) : std::nullopt;
              }) > 4000);
    }
    SECTION("perspective") {
        const Image image = render_floats(directory, perspective_view(200, 160, 40) + rest);
        CHECK(compare(image, 1e-5, 1e-5, [&](int x, int y) -> std::optional<Double3> {
                  const auto b = hit(k_triangle, k_eye, perspective_ray(image, x, y, 40), 0.01);
                  return b ? std::optional(mix(at_vertex, *b)) : std::nullopt;
              }) > 4000);
    }
}

TEST_CASE("a flat face is constant to the bit: a cube shows one colour per visible triangle") {
    const Image image = render_floats(
        scratch_directory(), perspective_view(200, 200, 30) + models("flat", "phong") +
                                 "[[light]]\ntype = \"point\"\nposition = [1.2, 1.6, 3]\nintensity = 9\n"
                                 "[[object]]\ntype = \"cube\"\nrotation = [30, 40, 0]\n");
    std::set<std::tuple<float, float, float>> colors;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const candela::Vec3 c = image.at(x, y);
            colors.emplace(c.x, c.y, c.z);
        }
    }
    CHECK(colors.size() == 6 + 1);  // two triangles on each of three faces, and the background
}

TEST_CASE("Phong and Blinn-Phong highlights match a per-pixel evaluation in double precision") {
    const auto directory = scratch_directory();
    write_file(directory / "triangle.obj", k_triangle.obj());
    const Double3 lamp{0.7, 0.9, 2.6};
    for (const bool blinn : {false, true}) {
        for (const double shininess : {5.0, 60.0}) {
            INFO((blinn ? "Blinn-Phong" : "Phong") << ", shininess " << shininess);
            const Image image = render_floats(
                directory,
                perspective_view(240, 200, 40) + models("phong", blinn ? "blinn-phong" : "phong") +
                    "[[light]]\ntype = \"point\"\nposition = [0.7, 0.9, 2.6]\nintensity = 2\n"
                    "[[light]]\ntype = \"ambient\"\ncolor = [51, 51, 51]\n" +
                    mesh_object(
                        fmt::format("ka = 0.5\nkd = 0.3\nks = 0.7\nshininess = {}", shininess).c_str()));
            const int compared = compare(image, 1e-4, 1e-5, [&](int x, int y) -> std::optional<Double3> {
                const Double3 ray = perspective_ray(image, x, y, 40);
                const auto b = hit(k_triangle, k_eye, ray, 0.01);
                if (!b) return std::nullopt;
                const Double3 p = mix(k_triangle.p, *b);
                const Double3 n = unit(mix(k_triangle.n, *b));
                const Double3 l = unit(lamp - p);
                const Double3 v = unit(k_eye - p);
                const double intensity = 2 / dot(lamp - p, lamp - p);
                const double cosine = dot(n, l);
                const double base = blinn ? dot(n, unit(l + v)) : dot(2 * cosine * n - l, v);
                const double highlight =
                    cosine > 0 ? 0.7 * intensity * std::pow(std::max(base, 0.0), shininess) : 0;
                return (0.5 * 0.2 + 0.3 * intensity * std::max(cosine, 0.0)) * k_color +
                       Double3{highlight, highlight, highlight};
            });
            CHECK(compared > 6000);
        }
    }
}

TEST_CASE("seen from behind, an open surface is lit on the visible side") {
    const auto directory = scratch_directory();
    write_file(directory / "triangle.obj", k_triangle.obj());
    const std::string scene = models("phong", "lambert") +
                              "[[light]]\ntype = \"directional\"\ndirection = [0, 0, 1]\n" +
                              mesh_object("ka = 0\nkd = 1");
    // The light travels along +z, so it falls on the side away from the observer at +z …
    const Image front = render_floats(directory, orthographic_view(64, 3) + scene);
    CHECK(front.at(32, 32) == candela::Vec3{0, 0, 0});
    // … and on the side that an observer at -z sees.
    const Image back =
        render_floats(directory, orthographic_view(64, 3) + scene, {"--set", "observer.position=[0,0,-4]"});
    CHECK(back.at(32, 32).x > 0.7f);
}
