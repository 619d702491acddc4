// Tangent frames of meshes, against those of other programs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "support/command.h"
#include "support/plugins.h"

using candela::Mesh;
using candela::Shape;
using candela::Vec3;

namespace {

constexpr int k_cells = 4;  // of a bumpy grid, along each side; its texture is mirrored in the middle column

struct GridVertex {
    Vec3 position, normal;
    float u, v;
};

Vec3 vec3(double x, double y, double z) {
    return {static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
}

GridVertex grid_vertex(int i, int j) {
    const double x = 0.2 * std::cos(i * 1.1), z = 0.25 * std::sin(j * 0.9 + i),
                 size = std::sqrt(x * x + 1 + z * z);
    return {vec3(i / 2.0 - 1, 0.3 * std::sin(i * 1.3 + j * 0.7), j / 2.0 - 1 + 0.1 * i),
            vec3(x / size, 1 / size, z / size), static_cast<float>(std::abs(i - 2) / 2.0 + 0.05 * j),
            static_cast<float>(j / 4.0 + 0.1 * std::sin(i))};
}

/// `is_soup`: each triangle has vertices of its own.
std::string grid(bool is_soup) {
    std::string vertices, faces;
    const auto add = [&](int i, int j) {
        const GridVertex at = grid_vertex(i, j);
        vertices += fmt::format("v {} {} {}\nvn {} {} {}\nvt {} {}\n", at.position.x, at.position.y,
                                at.position.z, at.normal.x, at.normal.y, at.normal.z, at.u, at.v);
    };
    for (int j = 0; j <= k_cells && !is_soup; ++j)
        for (int i = 0; i <= k_cells; ++i) add(i, j);
    int count = 0;
    for (int j = 0; j < k_cells; ++j) {
        for (int i = 0; i < k_cells; ++i) {
            const std::array<std::pair<int, int>, 6> corners{
                {{i, j}, {i, j + 1}, {i + 1, j + 1}, {i, j}, {i + 1, j + 1}, {i + 1, j}}};
            for (std::size_t k = 0; k < corners.size(); ++k) {
                const auto [a, b] = corners[k];
                if (is_soup) add(a, b);
                const int vertex = is_soup ? ++count : a + b * (k_cells + 1) + 1;
                faces += fmt::format("{}{}/{}/{}{}", k % 3 == 0 ? "f " : " ", vertex, vertex, vertex,
                                     k % 3 == 2 ? "\n" : "");
            }
        }
    }
    return vertices + faces;
}

Mesh with_derivatives(const std::string& obj) {
    return candela::build_mesh(
        *instance<Shape>("mesh", {{"file", write_file(scratch_directory() / "t.obj", obj).string()}}),
        {.uv = true, .derivatives = true}, {}, *instance<candela::ShadingModel>("phong"));
}

struct Expected {
    int vertex;  // column + 5 * row
    Vec3 tangent;
    int side;  // of the bitangent: of N x T, or opposite
};

// From mikktspace.c, Mikkelsen's own code, as it is in the npm package mikktspace 1.1.1.
constexpr Expected k_expected[] = {
    {0, {-0.96987f, 0.19397f, 0.14742f}, 1},  {1, {-0.99554f, 0.07967f, 0.05058f}, 1},
    {2, {0.81372f, -0.03610f, 0.58013f}, -1}, {2, {-0.96758f, -0.05801f, -0.24581f}, 1},
    {3, {0.84193f, 0.14797f, 0.51889f}, -1},  {4, {0.87361f, 0.14177f, 0.46551f}, -1},
    {5, {-0.97275f, 0.16208f, 0.16579f}, 1},  {6, {-0.99512f, 0.09583f, -0.02348f}, 1},
    {7, {0.86279f, 0.07162f, 0.50047f}, -1},  {7, {-0.96973f, -0.10084f, -0.22238f}, 1},
    {8, {0.86709f, 0.24575f, 0.43331f}, -1},  {9, {0.84788f, 0.17504f, 0.50047f}, -1},
    {10, {-0.98110f, 0.17743f, 0.07718f}, 1}, {11, {-0.99498f, 0.09330f, -0.03625f}, 1},
    {12, {0.88475f, 0.17049f, 0.43376f}, -1}, {12, {-0.99064f, -0.12500f, -0.05492f}, 1},
    {13, {0.85174f, 0.27871f, 0.44369f}, -1}, {14, {0.84998f, 0.11204f, 0.51477f}, -1},
    {15, {-0.97880f, 0.18678f, 0.08406f}, 1}, {16, {-0.99544f, 0.09307f, 0.02088f}, 1},
    {17, {0.85488f, 0.21828f, 0.47067f}, -1}, {17, {-0.99246f, -0.12128f, -0.01786f}, 1},
    {18, {0.85559f, 0.23264f, 0.46243f}, -1}, {19, {0.90707f, 0.01317f, 0.42078f}, -1},
    {20, {-0.96472f, 0.21044f, 0.15819f}, 1}, {21, {-0.99600f, 0.08921f, -0.00462f}, 1},
    {22, {0.86015f, 0.17675f, 0.47844f}, -1}, {22, {-0.98346f, -0.13483f, -0.12090f}, 1},
    {23, {0.89532f, 0.14399f, 0.42151f}, -1}, {24, {0.93222f, -0.02997f, 0.36065f}, -1}};

}  // namespace

TEST_CASE("shape/mesh: tangents at vertices are MikkTSpace's, also where the texture is mirrored") {
    for (const bool is_soup : {false, true}) {
        const Mesh mesh = with_derivatives(grid(is_soup));
        std::vector<bool> is_found(std::size(k_expected));
        for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
            const Vec3 p = mesh.position.span()[i], n = mesh.vertices[i].normal;
            const Vec3 dpdu = mesh.dpdu.span()[i], dpdv = mesh.dpdv.span()[i];
            const Vec3 t = normalized(dpdu);
            const int side = dot(cross(n, t), dpdv) > 0 ? 1 : -1;
            const auto* const same = std::ranges::find_if(k_expected, [&](const Expected& e) {
                const Vec3 at = grid_vertex(e.vertex % (k_cells + 1), e.vertex / (k_cells + 1)).position;
                return length(at - p) < 1e-5f && e.side == side;
            });
            INFO("vertex " << i << " at " << p.x << ' ' << p.y << ' ' << p.z << ", side " << side
                           << ", tangent " << t.x << ' ' << t.y << ' ' << t.z);
            REQUIRE(same != std::end(k_expected));
            is_found[static_cast<std::size_t>(same - k_expected)] = true;
            CHECK(length(t - same->tangent) < 1e-4f);
        }
        CHECK(std::ranges::count(is_found, false) == 0);
        if (!is_soup) CHECK(mesh.vertex_count() == std::size(k_expected));
    }
}

TEST_CASE("shape/mesh: vertices that are split for their tangents keep one normal") {
    // A roof without normals in the file, smooth over its ridge, whose texture is mirrored there.
    const Mesh mesh = with_derivatives(
        "s 1\nv -1 0 0\nv 0 0.2 0\nv 1 0 0\nv -1 0 2\nv 0 0.2 2\nv 1 0 2\nvt 1 0\nvt 0 0\nvt 1 1\nvt 0 1\n"
        "f 1/1 4/3 5/4 2/2\nf 2/2 5/4 6/3 3/1\n");
    CHECK(mesh.vertex_count() == 8);
    std::array<std::vector<Vec3>, 2> normals;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        if (mesh.position.span()[i].x != 0) continue;
        // Of one end of the ridge.
        const Vec3 n = mesh.vertices[i].normal;
        normals[mesh.position.span()[i].z > 1 ? 1 : 0].push_back(n);
        const Vec3 dpdu = mesh.dpdu.span()[i];
        // Its length is that along the slope.
        CHECK(std::abs(length(dpdu) - std::sqrt(1.04f)) < 1e-5f);
        CHECK(std::abs(dot(dpdu, n)) < 1e-6f);
    }
    for (const std::vector<Vec3>& two : normals) {
        REQUIRE(two.size() == 2);
        CHECK(two[0] == two[1]);
    }
}
