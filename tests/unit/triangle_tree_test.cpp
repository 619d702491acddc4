#include <atomic>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <iterator>
#include <limits>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "support/meshes.h"
#include "support/plugins.h"
#include "support/samples.h"

import candela.api;
import candela.geometry;

using candela::TriangleTree;
using candela::Vec3;

namespace {

TriangleTree tree_of(const candela::Mesh& mesh) {
    const candela::ConstVec3Span position = mesh.position.span();
    return {position, mesh.vertex_count(), mesh.indices};
}

struct Exit {
    std::uint32_t triangle;
    float distance;
    Vec3 barycentric;
};

std::vector<std::optional<Exit>> exits_of(const TriangleTree& tree, std::size_t count,
                                          candela::ConstVec3Span origin, candela::ConstVec3Span direction) {
    std::vector<std::uint32_t> triangle(count);
    std::vector<float> distance(count), x(count), y(count), z(count);
    tree.find_exits(count, origin, direction,
                    {triangle.data(), distance.data(), {x.data(), y.data(), z.data()}});
    std::vector<std::optional<Exit>> exits(count);
    for (std::size_t i = 0; i < count; ++i) {
        if (distance[i] >= 0) exits[i] = Exit{triangle[i], distance[i], {x[i], y[i], z[i]}};
    }
    return exits;
}

std::optional<Exit> exit_of(const TriangleTree& tree, Vec3 origin, Vec3 direction) {
    return exits_of(tree, 1, {&origin.x, &origin.y, &origin.z}, {&direction.x, &direction.y, &direction.z})
        .front();
}

Double3 at(Vec3 origin, Vec3 direction, double distance) {
    return exact(origin) + distance * exact(direction);
}

}  // namespace

TEST_CASE("a ray within a ball leaves it where the quadratic equation says") {
    const candela::Mesh ball = flat_mesh("sphere", {{"radius", 1.0}, {"segments", std::int64_t{256}}});
    const TriangleTree tree = tree_of(ball);
    Random random(11);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin = 0.57f * random.point(1), direction = random.direction();
        const double b = dot(exact(origin), exact(direction)), c = dot(exact(origin), exact(origin)) - 1;
        const auto exit = exit_of(tree, origin, direction);
        REQUIRE(exit.has_value());
        INFO(text(origin) << " along " << text(direction));
        CHECK(std::abs(static_cast<double>(exit->distance) - (-b + std::sqrt(b * b - c))) < 1e-3);
        // The barycentric coordinates give the same position.
        const auto corner = [&](std::size_t k) {
            return exact(ball.position.span()[ball.indices[3 * std::size_t{exit->triangle} + k]]);
        };
        const Vec3 w = exit->barycentric;
        const Double3 there = double{w.x} * corner(0) + double{w.y} * corner(1) + double{w.z} * corner(2);
        CHECK(length(there - at(origin, direction, static_cast<double>(exit->distance))) < 1e-5);
    }
}

TEST_CASE("a ray that enters through a point of the surface leaves elsewhere, and not where it entered") {
    const candela::Mesh cube = flat_mesh("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    Random random(12);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin{static_cast<float>(random.number(-0.99, 0.99)),
                          static_cast<float>(random.number(-0.99, 0.99)), 1};
        Vec3 direction = random.direction();
        direction.z = -std::abs(direction.z) - 0.01f;
        const auto exit = exit_of(tree, origin, direction);
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

TEST_CASE("a ray that starts close to a cube's edge leaves through the adjacent face, however close") {
    const candela::Mesh cube = flat_mesh("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    for (const float gap : {1e-2f, 1e-4f, 4e-6f, 1e-6f, 1.2e-7f, 0.0f}) {
        // From the face at the top, downwards, to the face on the right.
        const Vec3 origin{1 - gap, 0.3f, 1}, direction = candela::normalized(Vec3{1, 0.1f, -1});
        const auto exit = exit_of(tree, origin, direction);
        REQUIRE(exit.has_value());
        INFO("from " << text(origin));
        CHECK(std::abs(static_cast<double>(exit->distance) -
                       static_cast<double>(gap) / static_cast<double>(direction.x)) < 2e-6);
        const Vec3 corner = cube.position.span()[cube.indices[3 * std::size_t{exit->triangle}]];
        CHECK(corner.x == 1);
    }
}

TEST_CASE("a ray that starts on a surface and runs along it does not leave where it starts") {
    const candela::Mesh cube = flat_mesh("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    for (const float descent : {1e-1f, 1e-3f, 1e-5f, 1e-6f}) {
        const auto exit = exit_of(tree, {-0.5f, 0.25f, 1}, {1, 0, -descent});
        INFO("descent " << descent);
        REQUIRE(exit.has_value());
        CHECK(agree(static_cast<double>(exit->distance), 1.5, 1e-5));
    }
}

TEST_CASE("a ray along the edges and diagonals of a cube's faces does not slip between its triangles") {
    const candela::Mesh cube = flat_mesh("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    for (const Vec3 direction : {Vec3{1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, 0, -1}, Vec3{1, 1, 0}, Vec3{1, 1, 1},
                                 Vec3{-1, 1, -1}, Vec3{0, -1, -1}}) {
        const auto exit = exit_of(tree, {0, 0, 0}, direction);
        REQUIRE(exit.has_value());
        CHECK(exit->distance == 1);
    }
}

TEST_CASE("in a torus the path ends at the nearest wall, not at the far side of the hole") {
    const candela::Mesh ring =
        flat_mesh("torus", {{"major_radius", 1.0}, {"minor_radius", 0.25}, {"segments", std::int64_t{128}}});
    const auto exit = exit_of(tree_of(ring), {1, 0, 0}, {-1, 0, 0});
    REQUIRE(exit.has_value());
    CHECK(agree(static_cast<double>(exit->distance), 0.25, 2e-3));
}

TEST_CASE("where a surface is open, or absent, a ray does not leave") {
    const std::vector<float> x = {0, 1, 0}, y = {0, 0, 1}, z = {0, 0, 0};
    const std::vector<std::uint32_t> indices = {0, 1, 2};
    const TriangleTree one({x.data(), y.data(), z.data()}, 3, indices);
    CHECK(exit_of(one, {0.2f, 0.2f, -1}, {0, 0, 1}).has_value());
    CHECK_FALSE(exit_of(one, {0.2f, 0.2f, 1}, {0, 0, -1}).has_value());  // it enters there
    CHECK_FALSE(exit_of(one, {0.9f, 0.9f, -1}, {0, 0, 1}).has_value());
    CHECK_FALSE(exit_of(TriangleTree({}, 0, {}), {0, 0, 0}, {1, 0, 0}).has_value());
}

TEST_CASE("a ray leaves at the same place whatever other rays are traced with it") {
    // Towards corners and along diagonals, where several triangles are equally near, and anywhere.
    for (const char* const name : {"cube", "sphere", "torus"}) {
        const candela::Mesh mesh = flat_mesh(name, {});
        const TriangleTree tree = tree_of(mesh);
        const candela::ConstVec3Span vertices = mesh.position.span();
        Random random(14);
        constexpr std::size_t k_count = 1000;
        candela::Vec3Arrays origin, direction;
        origin.resize(k_count);
        direction.resize(k_count);
        for (std::size_t i = 0; i < k_count; ++i) {
            const auto vertex = [&] {
                return vertices[static_cast<std::size_t>(
                    random.number(0, static_cast<double>(mesh.vertex_count()) - 0.5))];
            };
            const Vec3 from = i % 3 == 0 ? 0.2f * random.point(1) : i % 3 == 1 ? vertex() : Vec3{};
            const Vec3 to = i % 2 == 0 ? vertex() : 0.5f * (vertex() + vertex());
            origin.span().set(i, from);
            direction.span().set(
                i, i % 5 == 0 || length(to - from) == 0 ? random.direction() : normalized(to - from));
        }
        const candela::ConstVec3Span origins = std::as_const(origin).span(),
                                     directions = std::as_const(direction).span();
        const auto together = exits_of(tree, k_count, origins, directions);
        std::size_t exits = 0;
        for (std::size_t i = 0; i < k_count; ++i) {
            const std::optional<Exit> alone = exit_of(tree, origins[i], directions[i]);
            INFO(name << ": " << text(origins[i]) << " along " << text(directions[i]));
            REQUIRE(alone.has_value() == together[i].has_value());
            if (!alone) continue;
            ++exits;
            CHECK(alone->triangle == together[i]->triangle);
            CHECK(alone->distance == together[i]->distance);
        }
        CHECK(exits > k_count / 4);
    }
}

TEST_CASE("a ray of a faulty plugin has no exit, and its neighbours keep theirs") {
    const candela::Mesh cube = flat_mesh("cube", {{"size", 2.0}});
    const TriangleTree tree = tree_of(cube);
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const std::vector<float> zero(16, 0.0f);
    std::vector<float> x(16, 1.0f);
    x[3] = nan;
    x[7] = std::numeric_limits<float>::infinity();
    x[11] = 1e30f;
    const auto exits =
        exits_of(tree, 16, {zero.data(), zero.data(), zero.data()}, {x.data(), zero.data(), zero.data()});
    for (std::size_t i = 0; i < 16; ++i) {
        CHECK(exits[i].has_value() == (x[i] == 1));
        if (exits[i]) CHECK(exits[i]->distance == 1);
    }
}

TEST_CASE("after rays have been followed, other work still uses several threads") {
    const TriangleTree tree = tree_of(flat_mesh("cube", {}));
    std::atomic<int> present = 0;
    std::atomic<bool> have_met = true;
    candela::with_threads(2, [&] {
        candela::parallel_for(2, 1, [&](std::size_t, std::size_t) {
            ++present;
            const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(20);
            while (present < 2 && std::chrono::steady_clock::now() < end) std::this_thread::yield();
            if (present < 2) have_met = false;
        });
    });
    CHECK(have_met);
}

TEST_CASE("a tree is built by the calling thread, and is thus the same however many there are") {
    const auto threads = [] {
        return std::distance(std::filesystem::directory_iterator("/proc/self/task"), {});
    };
    candela::with_threads(1, [&] {
        const candela::Mesh ball = flat_mesh("sphere", {{"segments", std::int64_t{512}}});
        const auto before = threads();
        tree_of(ball);
        CHECK(threads() == before);
    });
}

TEST_CASE("trees built at the same time give the same results as trees built one after the other") {
    std::vector<candela::Mesh> meshes;
    for (const std::int64_t segments : {16, 40, 100, 160})
        for (const char* const name : {"sphere", "torus"})
            meshes.push_back(flat_mesh(name, {{"segments", segments}}));
    // Towards corners, where the shape of the tree decides which of several triangles a ray hits.
    const auto exits = [&](const candela::Mesh& mesh, const TriangleTree& tree) {
        std::vector<std::pair<std::uint32_t, float>> result;
        const candela::ConstVec3Span vertices = mesh.position.span();
        for (std::size_t i = 0; i < mesh.vertex_count(); i += 7) {
            const Vec3 from = vertices[(i * 31) % mesh.vertex_count()], to = vertices[i];
            if (length(to - from) == 0) continue;
            const auto exit = exit_of(tree, from, normalized(to - from));
            result.emplace_back(exit ? exit->triangle : ~0u, exit ? exit->distance : -1);
        }
        return result;
    };
    std::vector<std::optional<TriangleTree>> trees(meshes.size());
    candela::with_threads(8, [&] {
        candela::parallel_for(meshes.size(), 1, [&](std::size_t first, std::size_t end) {
            for (std::size_t i = first; i < end; ++i) trees[i].emplace(tree_of(meshes[i]));
        });
    });
    for (std::size_t i = 0; i < meshes.size(); ++i)
        CHECK(exits(meshes[i], *trees[i]) == exits(meshes[i], tree_of(meshes[i])));
}
