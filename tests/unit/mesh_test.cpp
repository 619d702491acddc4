#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>
#include <stdexcept>
#include <utility>

#include "support/plugins.h"
#include "support/samples.h"
#include "support/text.h"

import candela.api;

using candela::Mesh;
using candela::Shape;
using candela::Transform;
using candela::Vec3;

namespace {

Mesh build(const Shape& shape, const Transform& transform = {}) {
    const auto shading = instance<candela::ShadingModel>("phong");
    return candela::build_mesh(shape, {.uv = true, .derivatives = true}, transform, *shading);
}

/// By the divergence theorem: positive if the triangles face outwards.
double volume(const Mesh& mesh) {
    double six = 0;
    const auto p = mesh.position.span();
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Double3 a = exact(p[mesh.indices[3 * t]]), b = exact(p[mesh.indices[3 * t + 1]]),
                      c = exact(p[mesh.indices[3 * t + 2]]);
        six += a.x * (b.y * c.z - b.z * c.y) - a.y * (b.x * c.z - b.z * c.x) + a.z * (b.x * c.y - b.y * c.x);
    }
    return six / 6;
}

/// Vertices, edges and faces, counting vertices at one position once, and the number of edges that are not
/// between two faces.
struct Topology {
    int euler = 0;
    int open_edges = 0;
};
Topology topology(const Mesh& mesh) {
    std::map<std::array<float, 3>, std::size_t> places;
    const auto place = [&](std::uint32_t v) {
        const Vec3 p = mesh.position.span()[v];
        return places.try_emplace({p.x + 0.0f, p.y + 0.0f, p.z + 0.0f}, places.size()).first->second;
    };
    std::map<std::pair<std::size_t, std::size_t>, int> edges;
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t a = place(mesh.indices[3 * t + k]),
                              b = place(mesh.indices[3 * t + (k + 1) % 3]);
            edges[std::minmax(a, b)] += a < b ? 1 : -1;
        }
    }
    Topology result;
    result.euler = static_cast<int>(places.size()) - static_cast<int>(edges.size()) +
                   static_cast<int>(mesh.triangle_count());
    for (const auto& [edge, balance] : edges) result.open_edges += balance != 0 ? 1 : 0;
    return result;
}

/// A shape from a list of triangles.
class GivenShape final : public Shape {
  public:
    GivenShape() = default;
    GivenShape(std::vector<Vec3> v, std::vector<std::uint32_t> c)
        : vertices(std::move(v)), indices(std::move(c)) {}

    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> indices;
    bool is_faceted = false;

    void tessellate(const candela::MeshRequest&, candela::MeshSink& sink) const override {
        const auto mesh = sink.allocate(
            {.vertices = vertices.size(), .triangles = indices.size() / 3, .is_faceted = is_faceted});
        for (std::size_t i = 0; i < vertices.size(); ++i) mesh.position.set(i, vertices[i]);
        std::copy(indices.begin(), indices.end(), mesh.indices.begin());
    }
};

GivenShape tetrahedron() {
    return GivenShape({{1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}},
                      {0, 1, 3, 0, 2, 1, 0, 3, 2, 1, 2, 3});
}

std::string complaint_about(const Shape& shape) {
    return message_of([&] { build(shape); });
}

}  // namespace

TEST_CASE("the closed shapes are closed, face outwards, and have their Euler characteristic and volume") {
    constexpr double k_pi = std::numbers::pi;
    struct Expected {
        const char* name;
        int euler;
        double volume;
        double tolerance;
    };
    for (const Expected& e : {Expected{"sphere", 2, 4 * k_pi / 3 * 0.125, 0.01}, Expected{"cube", 2, 1, 1e-6},
                              Expected{"torus", 0, 2 * k_pi * k_pi * 0.5 * 0.04, 0.01}}) {
        INFO(e.name);
        const Mesh mesh = build(*instance<Shape>(e.name));
        const Topology found = topology(mesh);
        CHECK(mesh.closed);
        CHECK(found.open_edges == 0);
        CHECK(found.euler == e.euler);
        CHECK(agree(volume(mesh), e.volume, e.tolerance));
    }
}

TEST_CASE("the smallest densities are still closed surfaces") {
    for (const char* const name : {"sphere", "torus"}) {
        for (const std::int64_t segments : {3, 4, 5, 7}) {
            INFO(name << " of " << segments);
            const Mesh mesh = build(*instance<Shape>(name, {{"segments", segments}}));
            CHECK(topology(mesh).open_edges == 0);
            CHECK(volume(mesh) > 0);
        }
    }
}

TEST_CASE("parametric shapes have exact derivatives: dp/du x dp/dv is the surface's normal") {
    const Mesh sphere = build(*instance<Shape>("sphere", {{"radius", 2.0}}));
    for (std::size_t i = 0; i < sphere.vertex_count(); ++i) {
        const Double3 p = exact(sphere.position.span()[i]);
        CHECK(agree(length(p), 2, 1e-6));
        const Vec3 n = cross(sphere.dpdu.span()[i], sphere.dpdv.span()[i]);
        if (length(n) < 1e-2f) continue;  // the poles
        CHECK(agree(dot(unit(exact(n)), unit(p)), 1, 1e-5));
    }
    const Mesh torus = build(*instance<Shape>("torus"));
    for (std::size_t i = 0; i < torus.vertex_count(); ++i) {
        const Double3 p = exact(torus.position.span()[i]);
        const double ring = std::hypot(p.x, p.z);
        const Double3 outwards = unit({p.x - 0.5 * p.x / ring, p.y, p.z - 0.5 * p.z / ring});
        CHECK(agree(dot(unit(exact(cross(torus.dpdu.span()[i], torus.dpdv.span()[i]))), outwards), 1, 1e-5));
    }
}

TEST_CASE("vertex normals of a fine sphere converge to the sphere's own, across the seam and at the poles") {
    const Mesh mesh = build(*instance<Shape>("sphere", {{"radius", 1.0}, {"segments", std::int64_t{256}}}));
    double worst = 1;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        worst = std::min(worst, dot(exact(mesh.vertices[i].normal), unit(exact(mesh.position.span()[i]))));
    }
    CHECK(worst > 0.99999);
}

TEST_CASE("a large mesh has the same vertices and normals whatever the number of threads") {
    const auto sphere = instance<Shape>("sphere", {{"segments", std::int64_t{400}}});
    Mesh by_one, by_four;
    candela::with_threads(1, [&] { by_one = build(*sphere); });
    candela::with_threads(4, [&] { by_four = build(*sphere); });
    REQUIRE(by_one.triangle_count() > 100'000);
    REQUIRE(by_one.vertices.size() == by_one.vertex_count());
    REQUIRE(by_four.vertices.size() == by_one.vertices.size());
    std::size_t wrong = 0;
    for (std::size_t i = 0; i < by_one.vertex_count(); ++i) {
        const candela::MeshVertex &a = by_one.vertices[i], &b = by_four.vertices[i];
        const Vec3 place = by_one.position.span()[i];
        if (a.position != place || b.position != place || a.normal != b.normal) ++wrong;
    }
    for (std::size_t t = 0; t < by_one.triangle_count(); ++t)
        if (by_one.face_normal.span()[t] != by_four.face_normal.span()[t]) ++wrong;
    CHECK(wrong == 0);
}

TEST_CASE("of several non-finite vertex normals the first is named, whatever the number of threads") {
    struct Broken final : candela::ShadingModel {
        candela::ShadingRate shading_rate() const noexcept override { return {}; }
        void normals(const candela::ShadingPointBatch&, const candela::Vec3Span&) const override {}
        void vertex_normals(const candela::MeshView& mesh, const candela::Vec3Span& normals) const override {
            ShadingModel::vertex_normals(mesh, normals);
            for (const std::size_t i : {60'000u, 20'011u, 40'000u})
                normals.y[i] = std::numeric_limits<float>::quiet_NaN();
        }
    };
    const auto sphere = instance<Shape>("sphere", {{"segments", std::int64_t{400}}});
    for (const int threads : {1, 4}) {
        candela::with_threads(threads, [&] {
            CHECK_THROWS_WITH(candela::build_mesh(*sphere, {}, {}, Broken()),
                              "its normal for vertex 20011 is non-finite");
        });
    }
}

TEST_CASE("a cube keeps its sharp edges: the normals of a corner are those of its faces") {
    const Mesh mesh = build(*instance<Shape>("cube"));
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            CHECK(mesh.vertices[mesh.indices[3 * t + k]].normal == mesh.face_normal.span()[t]);
        }
    }
}

TEST_CASE("objects are scaled, then rotated about x, y and z in turn, then moved") {
    GivenShape shape = tetrahedron();
    shape.vertices[0] = {1, 0, 0};
    const Mesh mesh = build(shape, {.position = {10, 20, 30}, .rotation = {90, 90, 0}, .scale = {2, 1, 1}});
    // (1, 0, 0) -> (2, 0, 0); about x: unchanged; about y by 90: (0, 0, -2); moved: (10, 20, 28).
    CHECK(agree(mesh.position.span()[0], Double3{10, 20, 28}, 1e-6, 1e-5));
    const Mesh other = build(shape, {.rotation = {0, 90, 90}});
    // About y: (0, 0, -1); about z: unchanged.
    CHECK(agree(other.position.span()[0], Double3{0, 0, -1}, 1e-6, 1e-6));
}

TEST_CASE("a mesh of unknown closedness is examined: vertices at one position count as one") {
    GivenShape shape = tetrahedron();
    CHECK(build(shape).closed);
    // Also with three separate vertices for every triangle.
    GivenShape soup;
    for (const std::uint32_t corner : shape.indices) {
        soup.indices.push_back(static_cast<std::uint32_t>(soup.vertices.size()));
        soup.vertices.push_back(shape.vertices[corner]);
    }
    CHECK(build(soup).closed);
    soup.indices.resize(9);
    const Mesh open = build(soup);
    CHECK_FALSE(open.closed);
    CHECK(open.open_edges == 3);
    // One triangle inside out: closed by count, but not consistently oriented.
    GivenShape inside_out = tetrahedron();
    std::swap(inside_out.indices[0], inside_out.indices[1]);
    CHECK_FALSE(build(inside_out).closed);
}

TEST_CASE("open edges are as many as a map of all edges finds, whatever the triangles") {
    Random random(17);
    for (int mesh = 0; mesh < 50; ++mesh) {
        // Few positions, so that many edges lie between two or more triangles; some vertices share one.
        GivenShape shape;
        const double places = random.number(4, 9);
        for (int i = 0; i < 12; ++i) {
            const auto x = static_cast<float>(std::floor(random.number(0, places)));
            shape.vertices.push_back({x, x == 0 && i % 2 == 0 ? -0.0f : 0.0f, x * x});
        }
        while (shape.indices.size() < 3 * 60) {
            std::array<std::uint32_t, 3> c{};
            for (std::uint32_t& corner : c) corner = static_cast<std::uint32_t>(random.number(0, 12));
            const auto at = [&](std::size_t k) { return shape.vertices[c[k]].x; };
            if (at(0) == at(1) || at(1) == at(2) || at(2) == at(0)) continue;
            shape.indices.insert(shape.indices.end(), c.begin(), c.end());
        }
        const Mesh built = build(shape);
        CHECK(built.open_edges == static_cast<std::size_t>(topology(built).open_edges));
    }
}

TEST_CASE("shapes make coordinates and derivatives only on request, and the same triangles in any case") {
    const auto shading = instance<candela::ShadingModel>("phong");
    for (const char* name : {"sphere", "torus", "cube", "teapot"}) {
        INFO(name);
        const auto shape = instance<Shape>(name);
        const Mesh all = build(*shape);
        CHECK(all.u.size() == all.vertex_count());
        CHECK(all.dpdv.size() == all.vertex_count());
        for (const candela::MeshRequest request :
             {candela::MeshRequest{}, {.uv = true}, {.derivatives = true}}) {
            const Mesh mesh = candela::build_mesh(*shape, request, {}, *shading);
            CHECK(mesh.indices == all.indices);
            CHECK(mesh.position.x == all.position.x);
            CHECK(mesh.position.y == all.position.y);
            CHECK(mesh.position.z == all.position.z);
            CHECK(mesh.u.size() == (request.uv ? all.u.size() : 0));
            CHECK(mesh.v == (request.uv ? all.v : decltype(mesh.v){}));
            CHECK(mesh.dpdu.x == (request.derivatives ? all.dpdu.x : decltype(mesh.v){}));
            CHECK(mesh.dpdv.z == (request.derivatives ? all.dpdv.z : decltype(mesh.v){}));
        }
    }
}

TEST_CASE("an invalid mesh is refused with a reason") {
    GivenShape empty;
    CHECK(holds(complaint_about(empty), "no triangles"));
    GivenShape wild = tetrahedron();
    wild.indices[4] = 77;
    CHECK(holds(complaint_about(wild), "vertex 77"));
    GivenShape infinite = tetrahedron();
    infinite.vertices[2].y = std::numeric_limits<float>::infinity();
    CHECK(holds(complaint_about(infinite), "vertex 2 is non-finite"));
    GivenShape faceted = tetrahedron();
    faceted.is_faceted = true;
    CHECK(holds(complaint_about(faceted), "no facets were requested"));
}

TEST_CASE("a shape too far away to compute with is refused with a reason, however it got there") {
    GivenShape far = tetrahedron();
    far.vertices[1].z = 2e9f;
    CHECK(holds(complaint_about(far), "vertex 1 at [-1, -1, 2e+09] is more than 1e+09 m away"));
    try {
        build(tetrahedron(), {.scale = {1e10f, 1, 1}});
        FAIL("it was taken");
    } catch (const candela::Error& problem) {
        CHECK(holds(std::string(problem.what()), "m away"));
        CHECK(problem.category() == candela::ErrorCategory::invalid_scene);
    }
}

TEST_CASE("a triangle without area has no normal, and does not affect its neighbours'") {
    GivenShape shape;
    shape.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}};
    shape.indices = {0, 1, 2, 0, 1, 3};
    const Mesh mesh = build(shape);
    CHECK(mesh.face_normal.span()[1] == Vec3{});
    CHECK(mesh.vertices[0].normal == Vec3{0, 0, 1});
}
