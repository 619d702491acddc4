#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <utility>
#include <vector>

#include "support/meshes.h"
#include "support/plugins.h"
#include "support/samples.h"

import candela.api;
import candela.geometry;

using candela::Crossing;
using candela::Occluder;
using candela::OcclusionTree;
using candela::ShadowRays;
using candela::Vec3;

namespace {

constexpr float k_infinity = std::numeric_limits<float>::infinity();

struct Ray {
    Vec3 origin, direction;
    float length = k_infinity;
    std::uint32_t flags = ShadowRays::k_traced;
};

/// Rays of one object, in the arrays that a tree takes.
class Rays {
  public:
    Rays(const std::vector<Ray>& rays, std::uint32_t object) : count_(rays.size()), object_(object) {
        const std::size_t whole =
            (count_ + OcclusionTree::k_packet - 1) / OcclusionTree::k_packet * OcclusionTree::k_packet;
        origin_.resize(whole);
        direction_.resize(whole);
        length_.resize(whole);
        flags_.resize(whole);
        for (std::size_t i = 0; i < count_; ++i) {
            origin_.span().set(i, rays[i].origin);
            direction_.span().set(i, rays[i].direction);
            length_[i] = rays[i].length;
            flags_[i] = rays[i].flags;
        }
    }
    ShadowRays get() const {
        return {count_,
                std::as_const(origin_).span(),
                std::as_const(direction_).span(),
                length_.data(),
                flags_.data(),
                object_};
    }
    std::vector<float> visible(const OcclusionTree& tree, std::vector<Crossing>& crossings) const {
        std::vector<float> result(length_.size());
        tree.find_visible(get(), result.data(), crossings);
        result.resize(count_);
        return result;
    }

  private:
    std::size_t count_;
    std::uint32_t object_;
    candela::Vec3Arrays origin_, direction_;
    std::vector<float> length_;
    std::vector<std::uint32_t> flags_;
};

constexpr std::uint32_t k_nowhere = 99;

std::vector<float> visible(const OcclusionTree& tree, const std::vector<Ray>& rays,
                           std::uint32_t object = k_nowhere) {
    std::vector<Crossing> crossings;
    return Rays(rays, object).visible(tree, crossings);
}

/// The ways of rays through occluder 0, zero where there is none.
std::vector<float> ways(const OcclusionTree& tree, const std::vector<Ray>& rays) {
    std::vector<Crossing> crossings;
    Rays(rays, k_nowhere).visible(tree, crossings);
    std::vector<float> result(rays.size());
    for (const Crossing& each : crossings) {
        CHECK(each.object == 0);
        CHECK(result[each.ray] == 0);
        result[each.ray] = each.length;
    }
    return result;
}

/// How far a ray is within the box from -1 to 1 in each coordinate.
double way_through_box(const Ray& ray) {
    const Double3 o = exact(ray.origin), d = exact(ray.direction);
    double begin = 0, end = static_cast<double>(ray.length);
    for (const auto& [from, along] : {std::pair(o.x, d.x), std::pair(o.y, d.y), std::pair(o.z, d.z)}) {
        if (along == 0 && std::abs(from) > 1) return 0;
        if (along == 0) continue;
        const double a = (-1 - from) / along, b = (1 - from) / along;
        begin = std::max(begin, std::min(a, b));
        end = std::min(end, std::max(a, b));
    }
    return std::max(end - begin, 0.0);
}

/// Rays towards corners, edges and diagonals, where several triangles are equally near, and anywhere.
std::vector<Ray> delicate_rays(const candela::Mesh& mesh, std::size_t count) {
    const candela::ConstVec3Span vertices = mesh.position.span();
    Random random(14);
    const auto index = [&](std::size_t of) {
        return static_cast<std::size_t>(random.number(0, static_cast<double>(of) - 0.5));
    };
    const auto vertex = [&] { return vertices[index(mesh.vertex_count())]; };
    std::vector<Ray> rays;
    while (rays.size() < count) {
        const std::size_t i = rays.size();
        const std::size_t first = 3 * index(mesh.triangle_count());
        const auto w = static_cast<float>(random.number(0, 1));
        const Vec3 edge = w * vertices[mesh.indices[first]] + (1 - w) * vertices[mesh.indices[first + 1]];
        const std::array from{3.0f * random.direction(), vertex() + 1e-6f * random.direction(), Vec3{0, 3, 0},
                              edge};
        const std::array to{vertex(), edge, 0.5f * (vertex() + vertex())};
        Vec3 way = to[i % 3] - from[i % 4];
        if (length(way) == 0) way = random.direction();
        rays.push_back({from[i % 4], normalized(way), i % 7 == 0 ? length(way) : k_infinity});
    }
    return rays;
}

}  // namespace

TEST_CASE("rays of a convex object that meet no other box are visible, and all others are as if traced") {
    const Given coarse{{"segments", 24}};
    std::vector<candela::Mesh> meshes;
    meshes.push_back(flat_mesh("sphere", coarse));
    meshes.push_back(flat_mesh("cube", {}, {.position = {1.5f, 0.4f, 0}}));
    meshes.push_back(flat_mesh("torus", coarse, {.position = {0, 2, 0}, .rotation = {30, 0, 20}}));
    REQUIRE(meshes[0].is_convex);
    REQUIRE(meshes[1].is_convex);
    REQUIRE(!meshes[2].is_convex);
    const auto tree_of = [&] {
        std::vector<Occluder> occluders;
        for (const candela::Mesh& mesh : meshes) occluders.push_back({.mesh = &mesh, .is_solid = true});
        return OcclusionTree(occluders);
    };
    const OcclusionTree culled = tree_of();
    for (candela::Mesh& mesh : meshes) mesh.is_convex = false;
    const OcclusionTree traced = tree_of();
    Random random(7);
    for (std::uint32_t object = 0; object < 2; ++object) {
        const candela::Mesh& mesh = meshes[object];
        std::vector<Ray> rays;
        while (rays.size() < 20'000) {
            const auto triangle = static_cast<std::uint32_t>(
                random.number(0, static_cast<double>(mesh.triangle_count()) - 0.5));
            const candela::ConstVec3Span p = mesh.position.span();
            const Vec3 a = p[mesh.indices[3 * triangle]], b = p[mesh.indices[3 * triangle + 1]],
                       c = p[mesh.indices[3 * triangle + 2]];
            const Vec3 normal = mesh.face_normal.span()[triangle];
            const Vec3 towards = random.direction();
            if (dot(normal, towards) <= 0.01f) continue;
            // Along an axis, some of them, where a box's planes are parallel to the ray.
            const Vec3 along = rays.size() % 5 == 0 && normal.y > 0.1f ? Vec3{0, 1, 0} : towards;
            rays.push_back(
                {(1 / 3.0f) * (a + b + c) + 1e-5f * normal, along, rays.size() % 3 == 0 ? 1.2f : k_infinity});
        }
        const std::vector<float> expected = visible(traced, rays, object);
        CHECK(visible(culled, rays, object) == expected);
        CHECK(std::ranges::count(expected, 0.0f) > 500);
        CHECK(std::ranges::count(expected, 1.0f) > 1000);
    }
}

TEST_CASE("a ray is blocked, or not, whatever other rays are traced with it") {
    for (const char* const name : {"cube", "sphere", "torus", "teapot"}) {
        const candela::Mesh mesh = flat_mesh(name);
        for (const bool is_solid : {true, false}) {
            const OcclusionTree tree(std::vector<Occluder>{{.mesh = &mesh, .is_solid = is_solid}});
            const std::vector<Ray> rays = delicate_rays(mesh, 40000);
            const std::vector<float> together = visible(tree, rays);
            int differing = 0;
            for (std::size_t i = 0; i < rays.size(); ++i)
                differing += visible(tree, {rays[i]})[0] != together[i] ? 1 : 0;
            INFO(name);
            CHECK(differing == 0);
            const auto blocked = std::ranges::count(together, 0.0f);
            CHECK(blocked > 20000);
            CHECK(blocked < 40000);
        }
    }
}

TEST_CASE("the way through a transparent object does not depend on other rays either") {
    for (const char* const name : {"cube", "sphere", "torus"}) {
        const candela::Mesh mesh = flat_mesh(name);
        const OcclusionTree tree(
            std::vector<Occluder>{{.mesh = &mesh, .is_solid = true, .is_transparent = true}});
        const std::vector<Ray> rays = delicate_rays(mesh, 10000);
        const std::vector<float> together = ways(tree, rays);
        int differing = 0;
        for (std::size_t i = 0; i < rays.size(); ++i)
            differing += ways(tree, {rays[i]})[0] != together[i] ? 1 : 0;
        INFO(name);
        CHECK(differing == 0);
    }
}

TEST_CASE("a solid object blocks light where it enters, and nowhere else") {
    const candela::Mesh ball = flat_mesh("sphere", {{"radius", 1.0}, {"segments", std::int64_t{200}}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &ball, .is_solid = true}});
    Random random(21);
    std::vector<Ray> rays;
    std::vector<bool> is_free;
    while (rays.size() < 4000) {
        const Ray ray{random.point(2), random.direction(), static_cast<float>(random.number(0.1, 4))};
        // Of the quadratic equation: where the ray enters, if it does.
        const Double3 o = exact(ray.origin), d = exact(ray.direction);
        const double b = dot(o, d), c = dot(o, o) - 1, root = b * b - c;
        const double enters = -b - std::sqrt(std::max(root, 0.0));
        // Not where the ball's facets decide.
        if (std::abs(root) < 0.01 || std::abs(enters) < 0.01 || std::abs(enters - double{ray.length}) < 0.01)
            continue;
        rays.push_back(ray);
        is_free.push_back(root < 0 || enters < 0 || enters > static_cast<double>(ray.length));
    }
    const std::vector<float> found = visible(tree, rays);
    for (std::size_t i = 0; i < rays.size(); ++i) {
        INFO(text(rays[i].origin) << " along " << text(rays[i].direction) << ", " << rays[i].length);
        CHECK((found[i] == 1) == is_free[i]);
    }
}

TEST_CASE("a surface that is not solid blocks light on both sides") {
    const candela::Mesh room = flat_mesh("cube", {{"size", 2.0}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &room}});
    const std::vector<float> found = visible(tree, {{{0, 0, 0}, {1, 0, 0}},
                                                    {{3, 0, 0}, {-1, 0, 0}},
                                                    {{0, 0, 0}, {1, 0, 0}, 0.9f},
                                                    {{3, 0, 0}, {1, 0, 0}}});
    CHECK(found == std::vector<float>{0, 0, 1, 1});
}

TEST_CASE("a ray that starts below a surface leaves its own object, whichever side is seen") {
    const candela::Mesh sheet = flat_mesh("cube", {{"size", 2.0}}),
                        wall = flat_mesh("cube", {{"size", 2.0}}, {.position = {0, 5, 0}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &sheet}, {.mesh = &wall}});
    constexpr std::uint32_t k_below = ShadowRays::k_traced | ShadowRays::k_from_below;
    constexpr std::uint32_t k_behind = k_below | ShadowRays::k_from_behind;
    const Ray out{{0, 0, 0}, {1, 0, 0}, k_infinity, k_below}, in{{3, 0, 0}, {-1, 0, 0}, 2.5f, k_behind};
    CHECK(visible(tree, {out}, 0)[0] == 1);
    CHECK(visible(tree, {out}, 1)[0] == 0);
    CHECK(visible(tree, {{in.origin, in.direction, in.length, k_below}}, 0)[0] == 0);
    CHECK(visible(tree, {in}, 0)[0] == 1);
    CHECK(visible(tree, {in}, 1)[0] == 0);
    // Another object is in the way.
    CHECK(visible(tree, {{{0, 0, 0}, {0, 1, 0}, k_infinity, k_below}}, 0)[0] == 0);
}

TEST_CASE(
    "the way through a transparent box is that between its planes, across diagonals, edges and corners") {
    const candela::Mesh box = flat_mesh("cube", {{"size", 2.0}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &box, .is_solid = true, .is_transparent = true}});
    std::vector<Ray> rays;
    for (int i = -36; i <= 36; ++i) {
        const float at = static_cast<float>(i) / 32;
        for (const float across : {at, -at, 0.0f, 0.5f}) {
            rays.push_back({{at, 3, across}, {0, -1, 0}});
            rays.push_back({{at, across, 3}, {0, 0, -1}, 10});
            rays.push_back({{0, 3, 0}, normalized(Vec3{at, -2, across})});
            rays.push_back({{at, 0, across}, normalized(Vec3{0.3f, 1, across})});  // from within
        }
    }
    const std::vector<float> found = ways(tree, rays);
    CHECK(std::ranges::count(visible(tree, rays), 1.0f) == static_cast<std::ptrdiff_t>(rays.size()));
    for (std::size_t i = 0; i < rays.size(); ++i) {
        const Vec3 o = rays[i].origin;
        // Along a face, or from a point of it, either answer is right.
        if (std::abs(o.x) == 1 || std::abs(o.y) == 1 || std::abs(o.z) == 1) continue;
        INFO(text(o) << " along " << text(rays[i].direction));
        CHECK(agree(double{found[i]}, way_through_box(rays[i]), 1e-5, 1e-5));
    }
}

TEST_CASE("light of a lamp within a transparent object passes from there on") {
    const candela::Mesh box = flat_mesh("cube", {{"size", 2.0}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &box, .is_solid = true, .is_transparent = true}});
    CHECK(agree(double{ways(tree, {{{0.2f, 3, 0.1f}, {0, -1, 0}, 2.5f}})[0]}, 0.5, 1e-6));
    CHECK(agree(double{ways(tree, {{{0.2f, 0.5f, 0.1f}, {0, -1, 0}, 2.5f}})[0]}, 1.5, 1e-6));
    CHECK(ways(tree, {{{0.2f, 3, 0.1f}, {0, -1, 0}, 1.5f}})[0] == 0);
}

TEST_CASE("a transparent surface that is open has no inside, and thus no colour") {
    candela::Mesh box = flat_mesh("cube", {{"size", 2.0}});
    box.indices.resize(6);
    box.open_edges = 4;
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &box, .is_transparent = true}});
    for (const Vec3 direction :
         {Vec3{1, 0, 0}, Vec3{-1, 0, 0}, Vec3{0, 1, 0}, Vec3{0, -1, 0}, Vec3{0, 0, 1}, Vec3{0, 0, -1}})
        CHECK(ways(tree, {{{0.2f, 0.1f, 0.3f}, direction, 10}})[0] == 0);
}

TEST_CASE("the blocker is the nearest triangle that blocks, not the nearest that is hit") {
    const candela::Mesh near = flat_mesh("cube", {{"size", 2.0}}),
                        far = flat_mesh("cube", {{"size", 2.0}}, {.position = {0, 5, 0}});
    const OcclusionTree tree(
        std::vector<Occluder>{{.mesh = &near, .is_solid = true}, {.mesh = &far, .is_solid = true}});
    const Rays rays(
        {{{0.2f, 0, 0.1f}, {0, 1, 0}}, {{0.2f, -3, 0.1f}, {0, 1, 0}}, {{0.2f, 5, 0.1f}, {0, 1, 0}}},
        k_nowhere);
    const auto from_within = tree.find_blocker(rays.get(), 0);
    REQUIRE(from_within.has_value());
    CHECK(from_within->object == 1);
    CHECK(from_within->distance == 4);
    CHECK(far.face_normal.span()[from_within->triangle].y == -1);
    const auto from_below = tree.find_blocker(rays.get(), 1);
    REQUIRE(from_below.has_value());
    CHECK(from_below->object == 0);
    CHECK(from_below->distance == 2);
    CHECK_FALSE(tree.find_blocker(rays.get(), 2).has_value());
}

TEST_CASE("triangles without area block nothing and do not disturb those that have one") {
    std::vector<Vec3> corners;
    Random random(22);
    for (std::size_t i = 0; i < 3000; ++i) {
        const Vec3 a = random.point(1), along = random.point(1);
        // A point, a line, a needle a billionth as wide as it is long, and what a triangle should be.
        const std::array b{a, a + along, a + along, a + along},
            c{a, a + 0.5f * along, a + 0.5f * along + 1e-9f * random.direction(),
              a + 0.2f * random.direction()};
        corners.insert(corners.end(), {a, b[i % 4], c[i % 4]});
    }
    const candela::Mesh mesh = loose_triangles(corners, {{-3, -3, -3}, {3, 3, 3}});
    candela::Mesh proper = mesh;
    proper.indices.clear();
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        if (i / 3 % 4 == 3) proper.indices.push_back(static_cast<std::uint32_t>(i));
    }
    std::vector<Ray> rays;
    for (int i = 0; i < 20000; ++i) rays.push_back({2.0f * random.direction(), random.direction(), 3});
    const OcclusionTree all(std::vector<Occluder>{{.mesh = &mesh}}),
        some(std::vector<Occluder>{{.mesh = &proper}});
    const std::vector<float> with = visible(all, rays), without = visible(some, rays);
    CHECK(with == without);
    CHECK(std::ranges::count(with, 0.0f) > 3000);
}

TEST_CASE("a tree of nothing blocks nothing") {
    const candela::Mesh empty;
    CHECK(visible(OcclusionTree(std::vector<Occluder>{}), {{{0, 0, 0}, {1, 0, 0}}})[0] == 1);
    CHECK(visible(OcclusionTree(std::vector<Occluder>{{}, {.mesh = &empty}}), {{{0, 0, 0}, {1, 0, 0}}})[0] ==
          1);
}

TEST_CASE("few objects, whose boxes are looked at first, block the same light as many") {
    const candela::Mesh box = flat_mesh("cube", {{"size", 1.0}}, {.rotation = {20, 30, 40}}),
                        ring = flat_mesh("torus", {}, {.position = {1, 0, 0}});
    std::vector<Occluder> few{{.mesh = &box, .is_solid = true}, {.mesh = &ring}};
    std::vector<Occluder> many = few;
    const candela::Mesh away = flat_mesh("cube", {}, {.position = {0, 1000, 0}});
    many.resize(100, {.mesh = &away, .is_solid = true});
    const OcclusionTree tree(few), larger(many);
    for (const std::uint32_t object : {0u, 1u, k_nowhere}) {
        std::vector<Ray> rays;
        Random random(23);
        const candela::Mesh& from = object == 1 ? ring : box;
        while (rays.size() < 20000) {
            const auto t =
                static_cast<std::size_t>(random.number(0, static_cast<double>(from.triangle_count()) - 0.5));
            const Vec3 n = from.face_normal.span()[t];
            Vec3 p{};
            for (std::size_t k = 0; k < 3; ++k)
                p = p + (1 / 3.0f) * from.vertices[from.indices[3 * t + k]].position;
            const Vec3 direction = rays.size() % 5 == 0 ? Vec3{0, 1, 0} : random.direction();
            if (object == k_nowhere || dot(n, direction) > 0)
                rays.push_back({object == k_nowhere ? random.point(2) : p + 1e-5f * n, direction,
                                static_cast<float>(random.number(0.5, 5))});
        }
        CHECK(visible(tree, rays, object) == visible(larger, rays, object));
    }
}
