// Inside and overlap, against bodies with known answers, and against dense sampling with winding numbers.
#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Body;
using candela::Mesh;
using candela::Transform;
using candela::Vec3;

namespace {

Mesh mesh_of(const char* shape, Given given, const Transform& transform = {}) {
    return candela::place(*instance<candela::Shape>(shape, given), {}, transform).mesh;
}

Body body_of(const Mesh& mesh, candela::Solidity solidity = candela::Solidity::solid) {
    return {mesh.position.span(), mesh.vertex_count(), mesh.indices, mesh.closed, solidity};
}

Mesh cube(Vec3 position, float size = 1, Vec3 rotation = {}) {
    return mesh_of("cube", {{"size", double{size}}}, {position, rotation, {1, 1, 1}});
}
Mesh sphere(Vec3 position, double radius, std::int64_t segments = 32) {
    return mesh_of("sphere", {{"radius", radius}, {"segments", segments}}, {position, {}, {1, 1, 1}});
}
Mesh torus(Vec3 position, Vec3 rotation = {}) {
    return mesh_of("torus", {{"major_radius", 1.0}, {"minor_radius", 0.3}, {"segments", std::int64_t{32}}},
                   {position, rotation, {1, 1, 1}});
}

bool overlap_of(const Mesh& a, const Mesh& b) {
    const Body first = body_of(a), second = body_of(b);
    const bool found = overlap(first, second);
    CHECK(overlap(second, first) == found);
    return found;
}

/// Several meshes as one.
Mesh joined(const std::vector<Mesh>& parts) {
    Mesh all;
    for (const Mesh& part : parts) {
        const auto first = static_cast<std::uint32_t>(all.vertex_count());
        const auto p = part.position.span();
        for (std::size_t i = 0; i < part.vertex_count(); ++i) {
            all.position.x.push_back(p.x[i]);
            all.position.y.push_back(p.y[i]);
            all.position.z.push_back(p.z[i]);
        }
        for (const std::uint32_t corner : part.indices) all.indices.push_back(first + corner);
    }
    all.closed = std::ranges::all_of(parts, [](const Mesh& part) { return part.closed; });
    return all;
}

Mesh inside_out(Mesh mesh) {
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) std::swap(mesh.indices[i], mesh.indices[i + 1]);
    return mesh;
}

/// The winding number of a closed mesh around a point, from solid angles summed one by one.
double winding_number(const Mesh& mesh, Double3 p) {
    double sum = 0;
    const auto position = mesh.position.span();
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Double3 a = exact(position[mesh.indices[i]]) - p, b = exact(position[mesh.indices[i + 1]]) - p,
                      c = exact(position[mesh.indices[i + 2]]) - p;
        const double na = length(a), nb = length(b), nc = length(c);
        sum +=
            std::atan2(dot(a, cross(b, c)), na * nb * nc + dot(a, b) * nc + dot(b, c) * na + dot(c, a) * nb);
    }
    return sum / (2 * std::numbers::pi);
}

/// A random point just below a mesh's surface.
Double3 point_below_surface(const Mesh& mesh, std::mt19937& random) {
    std::uniform_int_distribution<std::size_t> pick(0, mesh.triangle_count() - 1);
    std::uniform_real_distribution<double> unit(0, 1);
    const std::size_t t = 3 * pick(random);
    const auto position = mesh.position.span();
    const Double3 a = exact(position[mesh.indices[t]]), b = exact(position[mesh.indices[t + 1]]),
                  c = exact(position[mesh.indices[t + 2]]);
    double u = unit(random), v = unit(random);
    if (u + v > 1) u = 1 - u, v = 1 - v;
    const Double3 n = cross(b - a, c - a);
    return a + u * (b - a) + v * (c - a) - (1e-6 / std::max(length(n), 1e-12)) * n;
}

/// Whether sampling finds a point in both bodies: just below one's surface and inside the other.
bool sampling_finds_overlap(const Mesh& a, const Mesh& b, int samples, std::mt19937& random) {
    const auto finds = [&](const Mesh& from, const Mesh& in) {
        const candela::Box box = candela::box_around(in.position.span(), in.vertex_count());
        for (int i = 0; i < samples; ++i) {
            const Double3 p = point_below_surface(from, random);
            const Vec3 rounded{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
            if (box.contains(rounded) && winding_number(in, p) > 0.5) return true;
        }
        return false;
    };
    return finds(a, b) || finds(b, a);
}

struct RandomBody {
    std::string what;
    Mesh mesh;
};

RandomBody random_body(std::mt19937& random) {
    const auto between = [&](float low, float high) {
        return std::uniform_real_distribution<float>(low, high)(random);
    };
    const Transform transform{{between(-0.9f, 0.9f), between(-0.9f, 0.9f), between(-0.9f, 0.9f)},
                              {between(0, 360), between(0, 360), between(0, 360)},
                              {between(0.5f, 1.2f), between(0.5f, 1.2f), between(0.5f, 1.2f)}};
    const std::int64_t segments = std::uniform_int_distribution<int>(6, 24)(random);
    switch (random() % 3) {
        case 0:
            return {"cube", mesh_of("cube", {{"size", double{between(0.3f, 0.9f)}}}, transform)};
        case 1:
            return {"sphere",
                    mesh_of("sphere", {{"radius", double{between(0.2f, 0.6f)}}, {"segments", segments}},
                            transform)};
        default:
            return {"torus", mesh_of("torus",
                                     {{"major_radius", double{between(0.5f, 0.8f)}},
                                      {"minor_radius", double{between(0.1f, 0.2f)}},
                                      {"segments", segments}},
                                     transform)};
    }
}

}  // namespace

TEST_CASE("the hole of a torus is outside, its tube is inside, whatever its bounding box contains") {
    const Mesh ring = torus({}, {30, 40, 50});
    const Body body = body_of(ring);
    CHECK_FALSE(body.contains({0, 0, 0}));
    int in_tube = 0;
    std::mt19937 random(1);
    std::uniform_real_distribution<float> unit(-1.3f, 1.3f);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 p{unit(random), unit(random), unit(random)};
        const bool inside = std::abs(winding_number(ring, exact(p))) > 0.5;
        in_tube += inside ? 1 : 0;
        CHECK(body.contains(p) == inside);
    }
    CHECK(in_tube > 50);
}

TEST_CASE("rays along edges and through vertices do not confuse the inside test") {
    // Lattice points of a lattice of cubes: every ray along an axis or a diagonal meets edges.
    const Body body = body_of(cube({}, 2));
    for (const float x : {-1.5f, -0.5f, 0.0f, 0.5f, 1.5f}) {
        for (const float y : {-1.5f, -0.5f, 0.0f, 0.5f, 1.5f}) {
            for (const float z : {-1.5f, -0.5f, 0.0f, 0.5f, 1.5f}) {
                CHECK(body.contains({x, y, z}) == (std::max({std::abs(x), std::abs(y), std::abs(z)}) < 1));
            }
        }
    }
}

TEST_CASE("a point on the surface is not inside; a thousandth below it is") {
    const Body body = body_of(cube({}));
    CHECK_FALSE(body.contains({0.5f, 0.1f, 0.2f}));
    CHECK_FALSE(body.contains({0.5f, 0.5f, 0.5f}));
    CHECK(body.contains({0.499f, 0.1f, 0.2f}));
    CHECK_FALSE(body.contains({0.501f, 0.1f, 0.2f}));
}

TEST_CASE("a mesh that is inside out, or has a cavity, knows its inside") {
    CHECK(body_of(inside_out(cube({}))).contains({0.1f, 0.2f, 0.3f}));
    CHECK_FALSE(body_of(inside_out(cube({}))).contains({0.1f, 0.2f, 0.7f}));
    const Mesh hollow = joined({cube({}, 2), inside_out(cube({}, 1))});
    CHECK(body_of(hollow).contains({0.75f, 0, 0}));
    CHECK_FALSE(body_of(hollow).contains({0.25f, 0, 0}));
    CHECK_FALSE(overlap_of(hollow, cube({}, 0.9f)));
    CHECK_FALSE(overlap_of(hollow, cube({}, 1.0f)));
    CHECK(overlap_of(hollow, cube({}, 1.1f)));
}

TEST_CASE("the teapot, which is not closed, still has an inside") {
    const Body pot = body_of(mesh_of("teapot", {{"size", 1.0}, {"segments", std::int64_t{6}}}));
    CHECK(pot.contains({0, 0, 0}));
    CHECK_FALSE(pot.contains({0, 0.8f, 0}));
    CHECK_FALSE(pot.contains({2, 0, 0}));
}

TEST_CASE("bodies that touch do not overlap: faces, edges, corners, at any angle") {
    CHECK_FALSE(overlap_of(cube({}), cube({1, 0, 0})));
    CHECK_FALSE(overlap_of(cube({}), cube({1, 0.3f, -0.4f})));
    CHECK_FALSE(overlap_of(cube({}), cube({1, 1, 0})));
    CHECK_FALSE(overlap_of(cube({}), cube({1, 1, 1})));
    CHECK_FALSE(overlap_of(cube({}), cube({0, 0.75f, 0}, 0.5f)));
    CHECK_FALSE(overlap_of(cube({}), sphere({1, 0, 0}, 0.5)));
    CHECK_FALSE(overlap_of(sphere({}, 0.5), sphere({1, 0, 0}, 0.5)));
    for (int degrees = 0; degrees < 360; degrees += 7) {
        const float angle = static_cast<float>(degrees) * std::numbers::pi_v<float> / 180;
        const Vec3 next{std::cos(angle), 0, -std::sin(angle)};
        INFO(degrees);
        CHECK_FALSE(overlap_of(cube({}, 1, {0, static_cast<float>(degrees), 0}),
                               cube(next, 1, {0, static_cast<float>(degrees), 0})));
        const Vec3 nearer = 0.999f * next;
        CHECK(overlap_of(cube({}, 1, {0, static_cast<float>(degrees), 0}),
                         cube(nearer, 1, {0, static_cast<float>(degrees), 0})));
    }
}

TEST_CASE("a peg that fits its groove touches, and a thicker one overlaps") {
    const Mesh groove = joined({cube({-1, 0, 0}), cube({1, 0, 0}),
                                mesh_of("cube", {{"size", 1.0}}, {{0, -0.75f, 0}, {}, {3, 0.5f, 1}})});
    CHECK_FALSE(overlap_of(groove, cube({})));
    CHECK(overlap_of(groove, cube({}, 1.01f)));
    CHECK(overlap_of(groove, cube({0, -0.01f, 0})));
}

TEST_CASE("equal bodies at one place, and shifted along their own planes, overlap") {
    CHECK(overlap_of(cube({}), cube({})));
    CHECK(overlap_of(sphere({}, 0.5), sphere({}, 0.5)));
    CHECK(overlap_of(torus({}), torus({})));
    for (const float by : {0.001f, 0.25f, 0.5f, 0.9f, 0.999f}) {
        INFO(by);
        CHECK(overlap_of(cube({}), cube({by, 0, 0})));
        CHECK(overlap_of(cube({}), cube({by, by, 0})));
        CHECK(overlap_of(cube({}), cube({by, by, by})));
    }
}

TEST_CASE("one body wholly inside another overlaps it, as does a body of which only a part is inside") {
    CHECK(overlap_of(cube({}, 2), cube({0.1f, 0.2f, 0.3f}, 0.1f)));
    CHECK(overlap_of(sphere({}, 1), sphere({}, 0.3)));
    CHECK(overlap_of(joined({cube({5, 0, 0}), cube({}, 0.1f)}), cube({}, 2)));
    CHECK(overlap_of(torus({}), sphere({1, 0, 0}, 0.1)));
}

TEST_CASE(
    "a hollow body overlaps what crosses its surface, not what is inside; a solid one inside it stays "
    "solid") {
    const Body room = body_of(cube({}, 2), candela::Solidity::hollow);
    CHECK_FALSE(overlap(room, body_of(sphere({}, 0.3))));
    CHECK_FALSE(overlap(body_of(sphere({}, 0.3)), room));
    CHECK(overlap(room, body_of(sphere({1, 0, 0}, 0.3))));
    CHECK(overlap(room, body_of(cube({}, 3))));
}

TEST_CASE("a solid body may touch a hollow one from inside and from outside, at any size and place") {
    for (const float scale : {1e-3f, 1.0f, 1e4f}) {
        for (const Vec3 place : {Vec3{}, Vec3{3, -7, 5}}) {
            const Body room = body_of(cube(scale * place, 2 * scale), candela::Solidity::hollow);
            const auto overlaps = [&](Vec3 position, float size) {
                const Body other = body_of(cube(scale * (place + position), size * scale));
                const bool found = overlap(room, other);
                CHECK(overlap(other, room) == found);
                return found;
            };
            INFO(scale << " at " << place.x);
            CHECK_FALSE(overlaps({0.1f, -0.7f, 0.2f}, 0.6f));
            CHECK_FALSE(overlaps({0.97f, 0, 0}, 0.06f));
            CHECK_FALSE(overlaps({-0.7f, -0.7f, -0.7f}, 0.6f));  // in a corner
            CHECK_FALSE(overlaps({0, 1.5f, 0}, 1));
            CHECK(overlaps({0.1f, -0.701f, 0.2f}, 0.6f));
            CHECK(overlaps({0, 1.499f, 0}, 1));
        }
    }
}

TEST_CASE("linked rings, and a body in a ring's hole, do not overlap") {
    CHECK_FALSE(overlap_of(torus({}), torus({1, 0, 0}, {90, 0, 0})));
    CHECK(overlap_of(torus({}), torus({0.5f, 0, 0}, {90, 0, 0})));
    CHECK_FALSE(overlap_of(torus({}), sphere({}, 0.65)));
    CHECK(overlap_of(torus({}), sphere({}, 0.75)));
    // A torus in a torus's hole, flat.
    const Mesh small = mesh_of("torus", {{"major_radius", 0.5}, {"minor_radius", 0.15}});
    CHECK_FALSE(overlap_of(torus({}), small));
}

TEST_CASE("overlap agrees with sampling by winding numbers on 600 random pairs") {
    std::mt19937 random(20191107);
    int overlapping = 0;
    int apart = 0;
    int boxes_meet = 0;
    for (int pair = 0; pair < 600; ++pair) {
        const RandomBody a = random_body(random), b = random_body(random);
        const bool found = overlap(body_of(a.mesh), body_of(b.mesh));
        bool sampled = sampling_finds_overlap(a.mesh, b.mesh, 4000, random);
        // If they only graze each other, few samples hit.
        if (found && !sampled) sampled = sampling_finds_overlap(a.mesh, b.mesh, 400'000, random);
        INFO(pair << ": " << a.what << " and " << b.what);
        CHECK(found == sampled);
        (found ? overlapping : apart)++;
        if (!found) {
            const candela::BoxTree boxes(
                {candela::box_around(a.mesh.position.span(), a.mesh.vertex_count()),
                 candela::box_around(b.mesh.position.span(), b.mesh.vertex_count())});
            boxes_meet += boxes.meeting(0).empty() ? 0 : 1;
        }
    }
    CHECK(overlapping > 100);
    CHECK(apart > 100);
    CHECK(boxes_meet > 50);
}

TEST_CASE("the box tree finds exactly the boxes that a linear search finds") {
    std::mt19937 random(7);
    std::uniform_real_distribution<float> unit(0, 1);
    std::vector<candela::Box> boxes;
    for (int i = 0; i < 300; ++i) {
        const Vec3 low{unit(random), unit(random), unit(random)};
        boxes.push_back({low, low + 0.2f * Vec3{unit(random), unit(random), unit(random)}});
    }
    boxes.push_back({{1, 1, 1}, {2, 2, 2}});
    boxes.push_back({{2, 1, 1}, {3, 2, 2}});  // only touches
    const candela::BoxTree tree(boxes);
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        std::vector<std::size_t> expected, holding;
        const Vec3 p = boxes[i].low;
        for (std::size_t j = 0; j < boxes.size(); ++j) {
            const candela::Box &a = boxes[i], &b = boxes[j];
            if (i != j && a.low.x < b.high.x && b.low.x < a.high.x && a.low.y < b.high.y &&
                b.low.y < a.high.y && a.low.z < b.high.z && b.low.z < a.high.z) {
                expected.push_back(j);
            }
            if (b.contains(p)) holding.push_back(j);
        }
        CHECK(tree.meeting(i) == expected);
        CHECK(tree.at(p) == holding);
    }
    CHECK(candela::BoxTree({}).at({0, 0, 0}).empty());
}
