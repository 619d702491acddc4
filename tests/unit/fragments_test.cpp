#include <array>
#include <catch2/catch_approx.hpp>
#include <catch2/catch_test_macros.hpp>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "support/samples.h"

using candela::FragmentRun;
using candela::Vec3;
using Catch::Approx;

namespace {

/// A square of two triangles, whose corners all have different positions and normals.
candela::Mesh square() {
    candela::Mesh mesh;
    mesh.position.resize(4);
    mesh.face_normal.resize(2);
    const std::array<Vec3, 4> indices = {Vec3{-1, -1, 0}, Vec3{1, -1, -1}, Vec3{1, 1, 0.5f}, Vec3{-1, 1, 0}};
    for (std::size_t i = 0; i < 4; ++i) {
        mesh.position.span().set(i, indices[i]);
        mesh.vertices.push_back({.position = indices[i], .normal = {0.1f * static_cast<float>(i), 0.2f, 1}});
    }
    mesh.u = {0, 1, 0.75f, 0.125f};
    mesh.v = {0, 0.25f, 1, 0.5f};
    mesh.indices = {0, 1, 2, 0, 2, 3};
    mesh.face_normal.span().set(0, {0, 0, 1});
    mesh.face_normal.span().set(1, {0, 1, 0});
    return mesh;
}

struct SquareSeen {
    candela::Mesh mesh = square();
    std::array<const candela::Mesh*, 1> meshes{&mesh};
    candela::ProjectedScene scene =
        candela::project(meshes,
                         candela::Camera::looking({0, 0, 3}, {0, 0, 0}, {0, 1, 0},
                                                  candela::Projection::perspective, 40, 256, 256),
                         64, 1);
    candela::ProjectedMesh projected{scene, mesh, 0};
};

/// All attributes of a point.
using Point = std::array<Vec3, 7>;
Point point(const candela::SurfacePoints& points, std::size_t i) {
    return {points.position.span()[i],          points.vertex_normal.span()[i],
            points.face_normal.span()[i],       points.barycentric.span()[i],
            {points.u[i], points.v[i], 0},      {points.dudx[i], points.dvdx[i], 0},
            {points.dudy[i], points.dvdy[i], 0}};
}

/// Runs of `lengths` pixels, alternating between the two triangles.
struct Stretches {
    std::vector<FragmentRun> runs;
    std::vector<std::uint32_t> triangles;

    explicit Stretches(const std::vector<std::uint32_t>& lengths) {
        float x = 3.5f;
        std::uint32_t triangle = 0;
        for (const std::uint32_t length : lengths) {
            runs.push_back({.pixel = 0, .count = length, .x = x, .y = 100.5f, .weight = 1});
            triangles.insert(triangles.end(), length, triangle);
            x += 0.25f;
            triangle = 1 - triangle;
        }
    }
    candela::FragmentBatch batch() const { return {runs, triangles}; }
};

void require_filled(const candela::SurfacePoints& points, std::size_t count) {
    REQUIRE(points.count == count);
    REQUIRE(points.filled == (count + 15) / 16 * 16);
    for (std::size_t i = count; i < points.filled; ++i) {
        CHECK(point(points, i) == point(points, count - 1));
        CHECK(points.facing[i] == points.facing[count - 1]);
    }
}

}  // namespace

TEST_CASE("a batch of fragments is padded to whole vectors with its last one, whatever its runs") {
    const SquareSeen seen;
    candela::SurfacePoints points;
    // Short runs and long ones, alone and in sequence: each kind of interpolation, beginning anywhere.
    const std::vector<std::vector<std::uint32_t>> all = {
        {1},      {5},          {16},         {17},        {1, 16},    {16, 1},
        {3, 40},  {40, 3},      {7, 7, 7},    {20, 1, 20}, {1, 20, 1}, {15, 15, 15, 15},
        {10, 11}, {1, 1, 1, 1}, {200, 1, 55}, {5, 250, 1}};
    for (const std::vector<std::uint32_t>& lengths : all) {
        const Stretches stretches(lengths);
        std::vector<Point> one_by_one;
        for (FragmentRun run : stretches.runs) {
            const std::uint32_t length = run.count;
            run.count = 1;
            for (std::uint32_t i = 0; i < length; ++i, run.x += 1) {
                const std::uint32_t& triangle = stretches.triangles[one_by_one.size()];
                candela::gather_fragments(seen.projected, {{&run, 1}, {&triangle, 1}}, {.uv = true}, points);
                one_by_one.push_back(point(points, 0));
            }
        }
        candela::gather_fragments(seen.projected, stretches.batch(), {.uv = true}, points);
        require_filled(points, one_by_one.size());
        for (std::size_t i = 0; i < one_by_one.size(); ++i) CHECK(point(points, i) == one_by_one[i]);
    }
}

TEST_CASE("derivatives of texture coordinates are their changes from pixel to pixel") {
    const SquareSeen seen;
    candela::SurfacePoints points;
    const std::uint32_t triangle = 0;
    const auto uv_at = [&](float x, float y) {
        const FragmentRun run{.pixel = 0, .count = 1, .x = x, .y = y, .weight = 1};
        candela::gather_fragments(seen.projected, {{&run, 1}, {&triangle, 1}}, {.uv = true}, points);
        return Vec3{points.u[0], points.v[0], 0};
    };
    // Central differences; perspective bends the coordinates slightly in between.
    constexpr float k_step = 0.5f;
    const float x = 140, y = 150;
    const Vec3 by_x = uv_at(x + k_step, y) - uv_at(x - k_step, y);
    const Vec3 by_y = uv_at(x, y + k_step) - uv_at(x, y - k_step);
    uv_at(x, y);
    REQUIRE(points.barycentric.span()[0].x > 0.05f);
    REQUIRE(points.barycentric.span()[0].y > 0.05f);
    REQUIRE(points.barycentric.span()[0].z > 0.05f);
    CHECK(points.dudx[0] == Approx(by_x.x).epsilon(0.001));
    CHECK(points.dvdx[0] == Approx(by_x.y).epsilon(0.001));
    CHECK(points.dudy[0] == Approx(by_y.x).epsilon(0.001));
    CHECK(points.dvdy[0] == Approx(by_y.y).epsilon(0.001));
}

TEST_CASE("batches of faces and of vertices are padded in the same way") {
    const SquareSeen seen;
    candela::SurfacePoints points;
    const std::array<std::uint32_t, 2> faces = {1, 0};
    candela::gather_faces(seen.projected, faces, {}, points);
    require_filled(points, 2);
    const std::array<candela::VertexSide, 3> vertices = {candela::VertexSide{.vertex = 2, .is_back = false},
                                                         {.vertex = 0, .is_back = false},
                                                         {.vertex = 3, .is_back = true}};
    candela::gather_vertices(seen.projected, vertices, {}, points);
    require_filled(points, 3);
    CHECK(points.facing[15] == -1);
}

TEST_CASE("each point of a batch has its own triangle's vertices and their normals, if they are needed") {
    const SquareSeen seen;
    candela::SurfacePoints points;
    const auto require_corners = [&](std::size_t i, std::uint32_t triangle) {
        for (std::size_t k = 0; k < 3; ++k) {
            const candela::MeshVertex& vertex = seen.mesh.vertices[seen.mesh.indices[3 * triangle + k]];
            REQUIRE(points.corner_position[k].span()[i] == vertex.position);
            REQUIRE(points.corner_normal[k].span()[i] == vertex.normal);
        }
    };
    candela::gather_fragments(seen.projected, Stretches({3}).batch(), {.uv = true}, points);
    CHECK(points.corner_position[0].empty());

    const std::vector<std::uint32_t> lengths = {3, 40, 7, 1};
    candela::gather_fragments(seen.projected, Stretches(lengths).batch(), {.triangle = true}, points);
    std::size_t first = 0;
    for (std::size_t run = 0; run < lengths.size(); ++run) {
        for (std::size_t i = 0; i < lengths[run]; ++i) require_corners(first + i, run % 2);
        first += lengths[run];
    }
    for (std::size_t i = points.count; i < points.filled; ++i) require_corners(i, 1);

    const std::array<std::uint32_t, 2> faces = {1, 0};
    candela::gather_faces(seen.projected, faces, {.triangle = true}, points);
    require_corners(0, 1);
    for (std::size_t i = 1; i < points.filled; ++i) require_corners(i, 0);
}
