// Requirements for shading models.
#include <fmt/format.h>

#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "batch.h"
#include "fence.h"

import candela.api;

using candela::ShadingModel;
using candela::Vec3;

namespace {

/// A mesh with the inputs from which vertex normals are made.
struct Facets {
    std::vector<Vec3> position;
    std::vector<std::uint32_t> indices;

    std::vector<Vec3> vertex_normals(const ShadingModel& model) const;
    /// The model's accesses outside the mesh's arrays; empty if there are none.
    std::string trespass(const ShadingModel& model, Fence fence) const;

  private:
    Arrays positions() const;
    Arrays face_normals() const;
};

Arrays Facets::positions() const {
    Arrays points(3, position.size());
    for (std::size_t i = 0; i < position.size(); ++i) points.vec3(0).set(i, position[i]);
    return points;
}

Arrays Facets::face_normals() const {
    Arrays faces(3, indices.size() / 3);
    for (std::size_t t = 0; t < faces.count(); ++t) {
        const Vec3 a = position[indices[3 * t]], b = position[indices[3 * t + 1]],
                   c = position[indices[3 * t + 2]];
        faces.vec3(0).set(t, candela::normalized(cross(b - a, c - a)));
    }
    return faces;
}

std::string Facets::trespass(const ShadingModel& model, Fence fence) const {
    const std::size_t count = position.size();
    const auto named = [](const char* name) {
        return [name](std::size_t array) { return fmt::format("{}.{}", name, "xyz"[array]); };
    };
    const Arrays points = positions().fenced(fence, named("position")),
                 faces = face_normals().fenced(fence, named("face_normal"));
    Arrays normals = Arrays(3, count).fenced(fence, named("normals"));
    const Fenced corners("indices", indices.size() * sizeof(std::uint32_t), fence),
        groups("smooth_group", count * sizeof(std::uint32_t), fence);
    std::ranges::copy(indices, corners.as<std::uint32_t>());
    std::iota(groups.as<std::uint32_t>(), groups.as<std::uint32_t>() + count, 0u);
    return trespass_of([&] {
        model.vertex_normals({.position = points.vec3(0),
                              .indices = {corners.as<std::uint32_t>(), indices.size()},
                              .face_normal = faces.vec3(0),
                              .smooth_group = {groups.as<std::uint32_t>(), count},
                              .vertex_count = count,
                              .group_count = count,
                              .authored_normal = {}},
                             normals.vec3(0));
    });
}

std::vector<Vec3> Facets::vertex_normals(const ShadingModel& model) const {
    const std::size_t count = position.size();
    const Arrays points = positions(), faces = face_normals();
    Arrays normals(3, count);
    std::vector<std::uint32_t> group(count);
    std::iota(group.begin(), group.end(), 0u);
    normals.fill_with_canary();
    model.vertex_normals({.position = points.vec3(0),
                          .indices = indices,
                          .face_normal = faces.vec3(0),
                          .smooth_group = group,
                          .vertex_count = count,
                          .group_count = count,
                          .authored_normal = {}},
                         normals.vec3(0));
    if (const std::string where = normals.trespass(); !where.empty())
        FAIL("vertex_normals() writes " << where << " its array");
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < count; ++i) result.push_back(normals.at(0, i));
    return result;
}

/// A bumpy grid of 2 x 8 x 8 triangles.
Facets landscape(float bumps) {
    constexpr std::uint32_t k_side = 9;
    std::mt19937 random(3);
    std::uniform_real_distribution<float> height(-bumps, bumps);
    Facets mesh;
    for (std::uint32_t row = 0; row < k_side; ++row) {
        for (std::uint32_t column = 0; column < k_side; ++column)
            mesh.position.push_back({static_cast<float>(column), height(random), -static_cast<float>(row)});
    }
    for (std::uint32_t row = 0; row + 1 < k_side; ++row) {
        for (std::uint32_t column = 0; column + 1 < k_side; ++column) {
            const std::uint32_t a = row * k_side + column, b = a + 1, c = b + k_side, d = a + k_side;
            for (const std::uint32_t corner : {a, b, c, a, c, d}) mesh.indices.push_back(corner);
        }
    }
    return mesh;
}

float distance(Vec3 a, Vec3 b) { return candela::length(a - b); }

}  // namespace

TEST_CASE("mesh: vertex_normals() reads and writes nothing outside the mesh's arrays", "[shading]") {
    const Facets mesh = landscape(0.4f);
    for (const Values& values : many_values(4)) {
        const auto model = make<ShadingModel>(values);
        for (const Fence fence : {Fence::after, Fence::before}) {
            if (const std::string trespass = mesh.trespass(*model, fence); !trespass.empty())
                FAIL("vertex_normals() " << trespass << ", with " << values.text);
        }
    }
}

TEST_CASE("unit: normals are unit vectors, to a millionth, at every point and vertex", "[shading]") {
    const Arrays in = inputs_for(1000);
    for (const Values& values : many_values()) {
        const BatchSubject subject = batch_subject(values);
        const Arrays out = outputs_of(subject.calls.front(), in);
        for (std::size_t i = 0; i < in.count(); ++i) {
            if (!(std::abs(candela::length(out.at(0, i)) - 1) <= 1e-6f))
                FAIL("normals() returns a vector of length " << candela::length(out.at(0, i)) << ", for "
                                                             << text_of_input(in, i) << ", with "
                                                             << values.text);
        }
        for (const Vec3 n : landscape(0.4f).vertex_normals(*make<ShadingModel>(values))) {
            if (!(std::abs(candela::length(n) - 1) <= 1e-6f))
                FAIL("vertex_normals() returns a vector of length " << candela::length(n) << ", with "
                                                                    << values.text);
        }
    }
}

TEST_CASE("plane: on a plane, every normal is the plane's", "[shading]") {
    for (const Values& values : many_values(10)) {
        for (const Vec3 n : landscape(0).vertex_normals(*make<ShadingModel>(values))) {
            if (!(distance(n, {0, 1, 0}) <= 1e-6f))
                FAIL("a vertex of the plane y = 0 has the normal [" << n.x << ", " << n.y << ", " << n.z
                                                                    << "], with " << values.text);
        }
        Arrays in = inputs_for(100);
        const Vec3 up{0, 1, 0};
        for (std::size_t i = 0; i < 100; ++i) {
            in.vec3(0).set(i, up);
            in.vec3(24).set(i, (i % 2 == 0 ? 0.5f : 1.0f) * up);
            in.vec3(27).set(i, {0, 0, 2});
            in.vec3(30).set(i, {3, 0, 1});
            in.vec3(inputs::k_tangent).set(i, {0, 0, 1});
            put_triangle(in, i, {up, up, up});
        }
        const Arrays out = outputs_of(batch_subject(values).calls.front(), in);
        for (std::size_t i = 0; i < 100; ++i) {
            if (!(distance(out.at(0, i), up) <= 1e-6f))
                FAIL("a point of the plane y = 0 has the normal [" << out[0][i] << ", " << out[1][i] << ", "
                                                                   << out[2][i] << "], with " << values.text);
        }
    }
}

namespace {

/// Inherits vertex_normals().
class DefaultNormals final : public ShadingModel {
  public:
    candela::ShadingRate shading_rate() const noexcept override { return candela::ShadingRate::fragment; }
    void normals(const candela::ShadingPointBatch&, const candela::Vec3Span&) const override {}
};

}  // namespace

TEST_CASE("defaults: a model that declares the default vertex normals has them", "[shading]") {
    if (!subject().shading_needs.default_vertex_normals) SKIP("it declares vertex normals of its own");
    const Facets mesh = landscape(0.5f);
    const std::vector<Vec3> defaults = mesh.vertex_normals(DefaultNormals());
    for (const Values& values : many_values(10)) {
        const auto model = make<ShadingModel>(values);
        const std::vector<Vec3> own = mesh.vertex_normals(*model);
        for (std::size_t i = 0; i < own.size(); ++i) {
            if (!(distance(own[i], defaults[i]) <= 1e-6f))
                FAIL(
                    "its descriptor declares default_vertex_normals, but vertex_normals() returns another "
                    "normal "
                    "for vertex "
                    << i << ", with " << values.text);
        }
    }
}

TEST_CASE("order: vertex normals do not depend on the numbering of vertices and triangles", "[shading]") {
    const Facets mesh = landscape(0.5f);
    std::vector<std::uint32_t> place(mesh.position.size());
    std::iota(place.begin(), place.end(), 0u);
    std::shuffle(place.begin(), place.end(), std::mt19937(5));
    Facets shuffled{mesh.position, {}};
    for (std::size_t i = 0; i < place.size(); ++i) shuffled.position[place[i]] = mesh.position[i];
    for (std::size_t t = mesh.indices.size(); t > 0; t -= 3) {
        for (const std::size_t k : {1, 2, 0}) shuffled.indices.push_back(place[mesh.indices[t - 3 + k]]);
    }
    for (const Values& values : many_values(10)) {
        const auto model = make<ShadingModel>(values);
        const std::vector<Vec3> before = mesh.vertex_normals(*model), after = shuffled.vertex_normals(*model);
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (!(distance(before[i], after[place[i]]) <= 1e-5f))
                FAIL("with another numbering, vertex " << i << " has a different normal, with "
                                                       << values.text);
        }
    }
}

TEST_CASE("motion: turning and moving a mesh turns its normals", "[shading]") {
    const Facets mesh = landscape(0.5f);
    Facets moved = mesh;
    for (Vec3& p : moved.position) p = turned(p) + Vec3{1, 2, -3};
    for (const Values& values : many_values(10)) {
        const auto model = make<ShadingModel>(values);
        const std::vector<Vec3> before = mesh.vertex_normals(*model), after = moved.vertex_normals(*model);
        for (std::size_t i = 0; i < before.size(); ++i) {
            if (!(distance(turned(before[i]), after[i]) <= 2e-5f))
                FAIL("turning the mesh does not turn its normals, at vertex " << i << ", with "
                                                                              << values.text);
        }
    }
}

TEST_CASE("degenerate: triangles without area, and vertices without triangles, leave all normals finite",
          "[shading]") {
    Facets mesh = landscape(0.3f);
    mesh.position.insert(mesh.position.end(), {{20, 0, 0}, {21, 0, 0}, {22, 0, 0}, {30, 0, 0}});
    const auto last = static_cast<std::uint32_t>(mesh.position.size());
    for (const std::uint32_t corner : {last - 4, last - 3, last - 2, 5u, 5u, 6u, 7u, 7u, 7u})
        mesh.indices.push_back(corner);
    for (const Values& values : many_values(10)) {
        const std::vector<Vec3> normals = mesh.vertex_normals(*make<ShadingModel>(values));
        for (std::size_t i = 0; i < normals.size(); ++i) {
            if (!std::isfinite(normals[i].x + normals[i].y + normals[i].z))
                FAIL("with triangles without area, vertex " << i << " has the normal [" << normals[i].x
                                                            << ", " << normals[i].y << ", " << normals[i].z
                                                            << "], with " << values.text);
        }
        Arrays in = inputs_for(32);
        for (std::size_t i = 0; i < 32; ++i) {
            if (i < 16) in.vec3(24).set(i, {0, 0, 0});
            in.vec3(27).set(i, i < 8 ? Vec3{} : Vec3{1, 1, 1});
            in.vec3(30).set(i, {1, 1, 1});
            // Vertices that coincide, two or all, and normals that cancel each other.
            const Vec3 n = in.at(inputs::k_normal, i);
            const std::size_t corner = inputs::k_corner_positions;
            put_triangle(in, i, {n, i % 4 == 0 ? -n : n, n});
            in.vec3(corner + 3).set(i, in.at(corner, i));
            if (i % 2 == 0) in.vec3(corner + 6).set(i, in.at(corner, i));
        }
        const Arrays out = outputs_of(batch_subject(values).calls.front(), in);
        for (std::size_t i = 0; i < 32; ++i) {
            const Vec3 n = out.at(0, i);
            if (!std::isfinite(n.x + n.y + n.z))
                FAIL("where interpolated normals, derivatives or edges vanish, normals() returns ["
                     << n.x << ", " << n.y << ", " << n.z << "], with " << values.text);
        }
    }
}
