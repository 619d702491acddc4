#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <vector>

#include "support/plugins.h"
#include "support/samples.h"

import candela.geometry;

using candela::TriangleTree;
using candela::Vec3;

namespace {

candela::Mesh shape(const char* name, Given given) {
    return candela::build_mesh(*instance<candela::Shape>(name, given), {}, {},
                               *instance<candela::ShadingModel>("flat"));
}

TriangleTree tree_of(const candela::Mesh& mesh) {
    const candela::ConstVec3Span position = mesh.position.span();
    return {position, mesh.vertex_count(), mesh.indices};
}

Double3 at(Vec3 origin, Vec3 direction, double distance) {
    return exact(origin) + distance * exact(direction);
}

}  // namespace

TEST_CASE("a ray within a ball leaves it where the quadratic equation says") {
    const candela::Mesh ball = shape("sphere", {{"radius", 1.0}, {"segments", std::int64_t{256}}});
    const TriangleTree tree = tree_of(ball);
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin = 0.57f * random.point(1), direction = random.direction();
        const double b = dot(exact(origin), exact(direction)), c = dot(exact(origin), exact(origin)) - 1;
        const auto exit = tree.exit_of(origin, direction);
        REQUIRE(exit.has_value());
        INFO(text(origin) << " along " << text(direction));
        CHECK(std::abs(static_cast<double>(exit->distance) - (-b + std::sqrt(b * b - c))) < 1e-3);
        // Barycentric coordinates say the same place.
        const auto corner = [&](std::size_t k) {
            return exact(ball.position.span()[ball.indices[3 * std::size_t{exit->triangle} + k]]);
        };
        const Vec3 w = exit->barycentric;
        const Double3 there = double{w.x} * corner(0) + double{w.y} * corner(1) + double{w.z} * corner(2);
        CHECK(length(there - at(origin, direction, static_cast<double>(exit->distance))) < 1e-5);
    }
}

TEST_CASE("a ray that enters through a point of the surface leaves elsewhere, and not where it entered") {
    const candela::Mesh cube = shape("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    Random random(12);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin{static_cast<float>(random.number(-0.99, 0.99)),
                          static_cast<float>(random.number(-0.99, 0.99)), 1};
        Vec3 direction = random.direction();
        direction.z = -std::abs(direction.z) - 0.01f;
        const auto exit = tree.exit_of(origin, direction);
        REQUIRE(exit.has_value());
        // Of three pairs of planes, the nearest one ahead.
        const auto ahead = [](float p, float d) {
            return ((d > 0 ? 1 : -1) - double{p}) / (d == 0 ? 1e-30 : double{d});
        };
        const double nearest = std::min(
            {ahead(origin.x, direction.x), ahead(origin.y, direction.y), ahead(origin.z, direction.z)});
        CHECK(agree(static_cast<double>(exit->distance), nearest, 1e-5, 1e-5));
    }
}

TEST_CASE("a ray along the edges and diagonals of a cube's faces does not slip between its triangles") {
    const candela::Mesh cube = shape("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}, Vec3{1, 1, 0}, Vec3{1, 1, 1},
                                 Vec3{-1, 1, -1}, Vec3{0, -1, -1}}) {
        const auto exit = tree.exit_of({0, 0, 0}, direction);
        REQUIRE(exit.has_value());
        CHECK(exit->distance == 1);
    }
}

TEST_CASE("in a torus the way ends at the nearest wall, not at the far side of the hole") {
    const candela::Mesh ring =
        shape("torus", {{"major_radius", 1.0}, {"minor_radius", 0.25}, {"segments", std::int64_t{128}}});
    const auto exit = tree_of(ring).exit_of({1, 0, 0}, {-1, 0, 0});
    REQUIRE(exit.has_value());
    CHECK(agree(static_cast<double>(exit->distance), 0.25, 2e-3));
}

TEST_CASE("where a surface is open, or there is none, a ray does not leave") {
    const std::vector<float> x = {0, 1, 0}, y = {0, 0, 1}, z = {0, 0, 0};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    const TriangleTree one({x.data(), y.data(), z.data()}, 3, indices);
    CHECK(one.exit_of({0.2f, 0.2f, -1}, {0, 0, 1}).has_value());
    CHECK_FALSE(one.exit_of({0.2f, 0.2f, 1}, {0, 0, -1}).has_value());  // it comes in there
    CHECK_FALSE(one.exit_of({0.9f, 0.9f, -1}, {0, 0, 1}).has_value());
    CHECK_FALSE(TriangleTree({}, 0, {}).exit_of({0, 0, 0}, {1, 0, 0}).has_value());
}
