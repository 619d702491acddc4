// Flat triangles whose vertices are shared.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/compiled.h"
#include "support/plugins.h"

using candela::Mesh;

namespace {

/// A sphere of few triangles: 26 vertices, 48 triangles, none of them in one plane with its neighbours.
std::string ball() {
    std::string text = "v 0 1 0\nv 0 -1 0\n";
    const double pi = std::acos(-1.0);
    for (int ring = 1; ring < 4; ++ring)
        for (int k = 0; k < 8; ++k) {
            const double polar = pi * ring / 4, around = pi * (k + 0.25 * ring) / 4;
            text += fmt::format("v {} {} {}\n", std::sin(polar) * std::cos(around), std::cos(polar),
                                std::sin(polar) * std::sin(around));
        }
    const auto at = [](int ring, int k) { return 3 + 8 * ring + k % 8; };
    for (int k = 0; k < 8; ++k) {
        text += fmt::format("f 1 {} {}\nf 2 {} {}\n", at(0, k + 1), at(0, k), at(2, k), at(2, k + 1));
        for (int ring = 0; ring < 2; ++ring)
            text += fmt::format("f {} {} {}\nf {} {} {}\n", at(ring, k), at(ring, k + 1), at(ring + 1, k),
                                at(ring, k + 1), at(ring + 1, k + 1), at(ring + 1, k));
    }
    return text;
}

/// The ball in the light of a sun.
Compiled scene_with(const std::string& shading, const std::string& reflection = "lambert") {
    const auto folder = scratch_directory();
    write_file(folder / "ball.obj", ball());
    candela::SceneRequest request;
    request.files = {write_file(folder / "scene.toml", fmt::format(R"(version = 1
room = {{ width = 10, height = 10, depth = 10 }}
[observer]
position = [0, 1, 3]
look_at = [0, 0, 0]
[image]
width = 90
height = 70
[shading]
model = "{}"
[reflection]
model = "{}"
[[light]]
type = "directional"
direction = [-1, -2, -3]
[[object]]
type = "mesh"
file = "ball.obj"
crease_angle = 0
)",
                                                                   shading, reflection))};
    return compiled(request);
}

/// 8-bit levels.
std::vector<int> image_of(const candela::RenderScene& scene) {
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::byte,
                       candela::ColorEncoding::srgb);
    candela::render(scene, film, {.threads = 1});
    const auto bytes = film.view().bytes;
    return {bytes.begin(), bytes.end()};
}

int largest_difference(const std::vector<int>& a, const std::vector<int>& b) {
    int largest = 0;
    for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, std::abs(a[i] - b[i]));
    return largest;
}

}  // namespace

TEST_CASE("shape/mesh: flat triangles share their vertices where the shading model allows it") {
    const auto vertices = [](const char* shading) {
        const Compiled c = scene_with(shading);
        const Mesh& mesh = c.scene.objects[0].mesh;
        return std::pair(mesh.is_faceted, mesh.vertex_count());
    };
    CHECK(vertices("phong") == std::pair(true, std::size_t{26}));
    CHECK(vertices("flat") == std::pair(true, std::size_t{26}));
    // One a corner, for who lights vertices or weighs the normals there.
    for (const char* const shading : {"gouraud", "angle-weighted", "area-weighted", "max-weighted"})
        CHECK(vertices(shading) == std::pair(false, std::size_t{144}));
}

TEST_CASE(
    "shape/mesh: a faceted mesh looks as one with vertices for each corner, and as flat shading has it") {
    // In the light of a sun, Lambert's law gives one colour to each flat triangle, wherever it is evaluated.
    const auto flat = image_of(scene_with("flat").scene), phong = image_of(scene_with("phong").scene);
    CHECK(*std::ranges::max_element(flat) > 100);
    CHECK(largest_difference(flat, phong) <= 1);
    CHECK(largest_difference(phong, image_of(scene_with("angle-weighted").scene)) <= 1);
    CHECK(largest_difference(phong, image_of(scene_with("gouraud").scene)) <= 1);
    // A highlight moves within a triangle: the pictures of both kinds of vertices agree, and flat shading's
    // differs.
    const auto glossy = image_of(scene_with("phong", "blinn-phong").scene);
    CHECK(largest_difference(glossy, image_of(scene_with("angle-weighted", "blinn-phong").scene)) <= 1);
    CHECK(largest_difference(glossy, image_of(scene_with("flat", "blinn-phong").scene)) > 1);
}

TEST_CASE("shape/mesh: rays leave a faceted mesh by its triangles' normals") {
    const auto facets = image_of(scene_with("phong", "dielectric").scene);
    CHECK(largest_difference(facets, image_of(scene_with("angle-weighted", "dielectric").scene)) <= 1);
}
