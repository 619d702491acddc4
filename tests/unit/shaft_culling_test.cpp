#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "support/meshes.h"
#include "support/plugins.h"
#include "support/samples.h"

import candela.api;
import candela.geometry;

using candela::Box;
using candela::Occluder;
using candela::OcclusionTree;
using candela::ShadowRays;
using candela::Vec3;

namespace {

Vec3 within(Random& random, const Box& box) {
    const auto at = [&](float low, float high) {
        return static_cast<float>(random.number(double{low}, double{high}));
    };
    return {at(box.low.x, box.high.x), at(box.low.y, box.high.y), at(box.low.z, box.high.z)};
}

Box around(Vec3 middle, float half) {
    return {middle - Vec3{half, half, half}, middle + Vec3{half, half, half}};
}

/// A small part of a surface, in front of it by the thickness of a hair.
struct Region {
    Box box;
    Vec3 normal;
};

Region region_of(const candela::Mesh& mesh, Random& random, float half) {
    const auto t =
        static_cast<std::size_t>(random.number(0, static_cast<double>(mesh.triangle_count()) - 0.5));
    const Vec3 n = mesh.face_normal.span()[t];
    return {around(mesh.vertices[mesh.indices[3 * t]].position + 1e-4f * n, half), n};
}

/// Whether each of some rays reaches its end; towards a distant light if it has no place.
bool all_visible(const OcclusionTree& tree, const Box& from, const Box& light, bool is_distant,
                 std::uint32_t object, Random& random) {
    constexpr std::size_t k_count = 64;
    candela::Vec3Arrays origin, direction;
    origin.resize(k_count);
    direction.resize(k_count);
    std::vector<float> length(k_count, std::numeric_limits<float>::infinity()), visible(k_count);
    const std::vector<std::uint32_t> flags(k_count, ShadowRays::k_traced);
    for (std::size_t i = 0; i < k_count; ++i) {
        const Vec3 p = within(random, from);
        origin.span().set(i, p);
        direction.span().set(i, is_distant ? light.low : within(random, light) - p);
        if (!is_distant) length[i] = 1;
    }
    std::vector<candela::Crossing> crossings;
    tree.find_visible({k_count, std::as_const(origin).span(), std::as_const(direction).span(), length.data(),
                       flags.data(), object},
                      visible.data(), crossings);
    return crossings.empty() && std::ranges::all_of(visible, [](float each) { return each == 1; });
}

constexpr std::uint32_t k_nowhere = 99;

}  // namespace

TEST_CASE("where a shaft says that nothing can block light, no ray in it is blocked") {
    const Given fine{{"segments", std::int64_t{60}}}, coarse{{"segments", std::int64_t{9}}};
    std::vector<candela::Mesh> meshes;
    meshes.push_back(flat_mesh("torus", fine));
    meshes.push_back(flat_mesh("teapot", coarse, {.position = {0.3f, 1.5f, 0}}));
    meshes.push_back(flat_mesh("cube", {}, {.position = {2, 0, 1}, .rotation = {10, 20, 30}}));
    meshes.push_back(flat_mesh("torus", coarse, {.position = {-1, 0.6f, 1}, .rotation = {80, 0, 0}}));
    // Solid, open, and transparent.
    const OcclusionTree tree(
        std::vector<Occluder>{{.mesh = &meshes[0], .is_solid = true},
                              {.mesh = &meshes[1]},
                              {.mesh = &meshes[2], .is_solid = true},
                              {.mesh = &meshes[3], .is_solid = true, .is_transparent = true}});
    Random random(31);
    int certain = 0, wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
        const candela::Mesh& mesh = meshes[static_cast<std::size_t>(i % 4)];
        const Box from = region_of(mesh, random, i % 3 == 0 ? 0.0f : 0.04f).box;
        const bool is_distant = i % 5 == 0;
        const Vec3 direction = i % 15 == 0 ? Vec3{0, 1, 0} : random.direction();
        const Box light =
            is_distant ? Box{direction, direction} : around(5.0f * random.point(1), i % 2 == 0 ? 0.0f : 0.3f);
        const bool may_block =
            is_distant ? tree.may_block(from, direction, k_nowhere) : tree.may_block(from, light, k_nowhere);
        if (may_block) continue;
        ++certain;
        wrong += all_visible(tree, from, light, is_distant, k_nowhere, random) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(certain > 1500);
}

TEST_CASE("most of the light that leaves a fine, closed surface needs no rays") {
    const candela::Mesh ring = flat_mesh("torus", {{"segments", std::int64_t{200}}});
    const OcclusionTree solid(std::vector<Occluder>{{.mesh = &ring, .is_solid = true}}),
        open(std::vector<Occluder>{{.mesh = &ring}});
    Random random(32);
    int unblocked = 0, certain = 0, certain_if_open = 0;
    for (int i = 0; i < 4000; ++i) {
        const Region region = region_of(ring, random, 0.005f);
        const Box light = around(4.0f * random.direction(), 0);
        if (dot(normalized(light.low - region.box.low), region.normal) < 0.1f) continue;
        if (!all_visible(solid, region.box, light, false, 0, random)) continue;
        ++unblocked;
        certain += solid.may_block(region.box, light, 0) ? 0 : 1;
        certain_if_open += open.may_block(region.box, light, 0) ? 0 : 1;
    }
    CHECK(unblocked > 1000);
    CHECK(certain > unblocked * 8 / 10);
    // Whatever is near may block it on the other side.
    CHECK(certain_if_open == 0);
}

TEST_CASE(
    "needles and triangles without area block light at the same places whether shafts are used or not") {
    std::vector<Vec3> corners;
    Random random(33);
    for (int i = 0; i < 300; ++i) {
        const Vec3 a = random.point(1), along = random.point(0.5f);
        const float width = std::pow(10.0f, -static_cast<float>(i % 9));
        corners.insert(corners.end(),
                       {a, i % 50 == 0 ? a : a + along, a + 0.5f * along + width * random.direction()});
    }
    const candela::Mesh mesh = loose_triangles(corners, {{-2, -2, -2}, {2, 2, 2}});
    const OcclusionTree tree(std::vector<Occluder>{{.mesh = &mesh, .is_solid = true}});
    int certain = 0, wrong = 0;
    for (int i = 0; i < 20'000; ++i) {
        const Box from = around(random.point(1.5f), 0), light = around(random.point(1.5f), 0);
        if (tree.may_block(from, light, k_nowhere)) continue;
        ++certain;
        wrong += all_visible(tree, from, light, false, k_nowhere, random) ? 0 : 1;
    }
    CHECK(wrong == 0);
    CHECK(certain > 500);
}
