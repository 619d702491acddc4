// Requirements for shapes, and for what they declare.
#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "at_once.h"
#include "fence.h"
#include "subject.h"

import candela.api;
import candela.geometry;

using candela::Mesh;
using candela::Vec3;

namespace {

Mesh mesh_of(const Values& values) {
    try {
        return candela::place(*make<candela::Shape>(values), {.uv = true, .derivatives = true}, {}).mesh;
    } catch (const std::exception& problem) {
        FAIL("its mesh cannot be used: " << problem.what() << ", with " << values.text);
        throw;
    }
}

struct Topology {
    int euler = 0;
    std::size_t open_edges = 0;
    std::size_t flat = 0;  // triangles without area
    double volume = 0;
};

/// Vertices at one position count as one.
Topology topology_of(const Mesh& mesh) {
    const auto p = mesh.position.span();
    const std::vector<std::uint32_t> place = candela::welded(p, mesh.vertex_count());
    std::map<std::uint32_t, int> vertices;
    std::map<std::pair<std::uint32_t, std::uint32_t>, int> edges;
    Topology result;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        std::array<std::uint32_t, 3> c{};
        for (std::size_t k = 0; k < 3; ++k) vertices[c[k] = place[mesh.indices[t + k]]] = 1;
        for (std::size_t k = 0; k < 3; ++k)
            edges[std::minmax(c[k], c[(k + 1) % 3])] += c[k] < c[(k + 1) % 3] ? 1 : -1;
        const Vec3 normal = cross(p[c[1]] - p[c[0]], p[c[2]] - p[c[0]]);
        if (candela::length(normal) == 0) ++result.flat;
        result.volume += double{dot(p[c[0]], cross(p[c[1]], p[c[2]]))} / 6;
    }
    result.euler = static_cast<int>(vertices.size()) - static_cast<int>(edges.size()) +
                   static_cast<int>(mesh.triangle_count());
    result.open_edges = static_cast<std::size_t>(
        std::ranges::count_if(edges, [](const auto& edge) { return edge.second != 0; }));
    return result;
}

bool is_same(const Mesh& a, const Mesh& b) {
    const auto same = [](const candela::Vec3Arrays& x, const candela::Vec3Arrays& y) {
        return x.x == y.x && x.y == y.y && x.z == y.z;
    };
    return a.indices == b.indices && same(a.position, b.position) && a.u == b.u && a.v == b.v &&
           same(a.dpdu, b.dpdu) && same(a.dpdv, b.dpdv) && same(a.color, b.color);
}

/// Arrays that end, or begin, at inaccessible memory.
class FencedMesh final : public candela::MeshSink {
  public:
    explicit FencedMesh(Fence fence) : fence_(fence) {}

    candela::MeshSpans allocate(const candela::MeshLayout& layout) override {
        const std::size_t n = layout.vertices;
        const auto vec3 = [&](const std::string& name, bool is_there = true) {
            candela::Vec3Span span;
            for (const auto& [axis, array] :
                 {std::pair{".x", &span.x}, std::pair{".y", &span.y}, std::pair{".z", &span.z}})
                if (is_there) *array = make<float>(name + axis, n);
            return span;
        };
        const auto indices = [&](const char* name, std::size_t count) {
            return std::span(make<std::uint32_t>(name, count), count);
        };
        candela::MeshSpans mesh{.position = vec3("position"),
                                .indices = indices("indices", 3 * layout.triangles),
                                .normal = vec3("normal", layout.has_normals),
                                .uv = {},
                                .dpdu = vec3("dpdu", layout.has_derivatives),
                                .dpdv = vec3("dpdv", layout.has_derivatives),
                                .smooth_group = {},
                                .color = vec3("color", layout.has_color)};
        if (layout.has_uv) mesh.uv = {make<float>("uv.x", n), make<float>("uv.y", n)};
        if (layout.has_smooth_groups) mesh.smooth_group = indices("smooth_group", n);
        return mesh;
    }

  private:
    template <class T>
    T* make(const std::string& name, std::size_t count) {
        return arrays_.emplace_back(std::make_unique<Fenced>(name, count * sizeof(T), fence_))
            ->template as<T>();
    }

    Fence fence_;
    std::vector<std::unique_ptr<Fenced>> arrays_;
};

void skip_if_it_needs_a_file() {
    if (needs_a_file()) SKIP("it needs a file that only a user has");
}

}  // namespace

TEST_CASE("usable: it has triangles of existing vertices, at finite positions", "[shape]") {
    skip_if_it_needs_a_file();
    for (const Values& values : many_values(10)) {
        if (mesh_of(values).triangle_count() == 0) FAIL("it has no triangles, with " << values.text);
    }
}

TEST_CASE("bounds: nothing is read or written outside the mesh's arrays", "[shape]") {
    skip_if_it_needs_a_file();
    for (const Values& values : many_values(4)) {
        const auto shape = make<candela::Shape>(values);
        for (const Fence fence : {Fence::after, Fence::before}) {
            FencedMesh mesh(fence);
            const std::string trespass = trespass_of(
                [&] { shape->tessellate({.uv = true, .derivatives = true, .color = true}, mesh); });
            if (!trespass.empty()) FAIL("tessellate() " << trespass << ", with " << values.text);
        }
    }
}

TEST_CASE("closed, if declared: every edge lies between two triangles that agree on which side is outside",
          "[shape]") {
    skip_if_it_needs_a_file();
    if (!declares("closed")) {
        if (!declares("open")) FAIL("it declares neither 'closed' nor 'open'");
        SKIP("it declares itself open");
    }
    for (const Values& values : many_values(10)) {
        const Topology found = topology_of(mesh_of(values));
        if (found.open_edges > 0)
            FAIL("declared closed, it has "
                 << found.open_edges << " edges that do not lie between two triangles, with " << values.text);
        if (found.volume <= 0)
            FAIL("it is inside out: its triangles enclose a volume of " << found.volume << ", with "
                                                                        << values.text);
    }
}

TEST_CASE("convex, if laid out as such: no vertex is above the plane of a triangle", "[shape]") {
    skip_if_it_needs_a_file();
    bool is_ever_convex = false;
    for (const Values& values : many_values(4)) {
        const Mesh mesh = mesh_of(values);
        if (!mesh.is_convex) continue;
        is_ever_convex = true;
        const auto p = mesh.position.span();
        const Vec3 size = mesh.bounds.high - mesh.bounds.low;
        const double tolerance = 1e-5 * std::max({size.x, size.y, size.z});
        // Some of them, so that it takes no longer than the others.
        const std::size_t step = 3 * (1 + mesh.triangle_count() / 500),
                          stride = 1 + mesh.vertex_count() / 500;
        for (std::size_t t = 0; t < mesh.indices.size(); t += step) {
            const Vec3 a = p[mesh.indices[t]];
            const Vec3 normal =
                candela::normalized(cross(p[mesh.indices[t + 1]] - a, p[mesh.indices[t + 2]] - a));
            for (std::size_t i = 0; i < mesh.vertex_count(); i += stride) {
                const auto above = double{dot(normal, p[i] - a)};
                if (above > tolerance)
                    FAIL("vertex " << i << " is " << above << " m above triangle " << t / 3 << ", with "
                                   << values.text);
            }
        }
    }
    if (!is_ever_convex) SKIP("it is not");
}

TEST_CASE("Euler characteristic, as declared", "[shape]") {
    skip_if_it_needs_a_file();
    const std::string declared_number = declared("euler-characteristic");
    if (declared_number.empty()) SKIP("not declared");
    const int euler = topology_of(mesh_of(default_values())).euler;
    if (std::to_string(euler) != declared_number)
        FAIL("vertices - edges + faces is " << euler << ", but declared is " << declared_number);
}

TEST_CASE("area: every triangle has one, with the default values", "[shape]") {
    skip_if_it_needs_a_file();
    const Topology found = topology_of(mesh_of(default_values()));
    if (found.flat > 0) FAIL(found.flat << " triangles have no area");
}

TEST_CASE("normals: authored ones, and derivatives if there are any, agree with the faces", "[shape]") {
    skip_if_it_needs_a_file();
    const Values values = default_values();
    const candela::PlacedShape placed =
        candela::place(*make<candela::Shape>(values), {.uv = true, .derivatives = true}, {});
    const Mesh& mesh = placed.mesh;
    if (placed.authored_normal.empty() && mesh.dpdu.empty()) SKIP("it has neither normals nor derivatives");
    const auto p = mesh.position.span();
    std::size_t against = 0, all = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        const Vec3 face =
            cross(p[mesh.indices[t + 1]] - p[mesh.indices[t]], p[mesh.indices[t + 2]] - p[mesh.indices[t]]);
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t v = mesh.indices[t + k];
            const auto judge = [&](Vec3 normal) {
                if (candela::length(normal) < 1e-6f) return;  // a pole
                ++all;
                if (dot(normal, face) <= 0) ++against;
            };
            if (!placed.authored_normal.empty()) judge(placed.authored_normal.span()[v]);
            if (!mesh.dpdu.empty()) judge(cross(mesh.dpdu.span()[v], mesh.dpdv.span()[v]));
        }
    }
    if (against > 0)
        FAIL(against << " of " << all
                     << " normals (or dp/du x dp/dv) at corners point to the other side than their triangle");
}

TEST_CASE("derivatives: dp/du and dp/dv are the changes of position with u and v", "[shape]") {
    skip_if_it_needs_a_file();
    const Mesh mesh = mesh_of(default_values());
    if (mesh.dpdu.empty() || mesh.u.empty()) SKIP("it has no derivatives");
    const auto p = mesh.position.span(), du = mesh.dpdu.span(), dv = mesh.dpdv.span();
    std::size_t differing = 0, all = 0;
    float told = 0, found = 0;
    for (std::size_t t = 0; t < mesh.indices.size(); t += 3) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::uint32_t a = mesh.indices[t + k], b = mesh.indices[t + (k + 1) % 3];
            const Vec3 edge = p[b] - p[a];
            // The trapezoidal rule: what the derivatives at both ends predict.
            const Vec3 promised = 0.5f * ((mesh.u[b] - mesh.u[a]) * (du[a] + du[b]) +
                                          (mesh.v[b] - mesh.v[a]) * (dv[a] + dv[b]));
            if (candela::length(edge) == 0) continue;
            ++all;
            if (candela::length(promised - edge) <= 0.3f * candela::length(edge)) continue;
            if (differing++ == 0) told = candela::length(promised), found = candela::length(edge);
        }
    }
    constexpr double k_may_be_at_poles = 0.2;
    if (static_cast<double>(differing) > k_may_be_at_poles * static_cast<double>(all))
        FAIL("along " << differing << " of " << all
                      << " edges dp/du and dp/dv disagree with the positions; along the first they predict "
                      << told << " m, but it is " << found << " m long");
}

TEST_CASE("bounding box, as declared for the default values", "[shape]") {
    skip_if_it_needs_a_file();
    const std::string text = declared("bounding-box");
    if (text.empty()) SKIP("not declared");
    std::array<float, 6> b{};
    if (std::sscanf(text.c_str(), "%f %f %f %f %f %f", &b[0], &b[1], &b[2], &b[3], &b[4], &b[5]) != 6)
        FAIL("'bounding-box' is declared as '" << text
                                               << "'; its value is six numbers, low x y z, high x y z");
    const Mesh mesh = mesh_of(default_values());
    const candela::Box box = candela::box_around(mesh.position.span(), mesh.vertex_count());
    const Vec3 low{b[0], b[1], b[2]}, high{b[3], b[4], b[5]};
    const float allowed = 0.01f * candela::length(high - low);
    if (candela::length(box.low - low) > allowed || candela::length(box.high - high) > allowed)
        FAIL("it reaches from [" << box.low.x << ", " << box.low.y << ", " << box.low.z << "] to ["
                                 << box.high.x << ", " << box.high.y << ", " << box.high.z
                                 << "], but declared is " << text);
}

TEST_CASE("density: with more segments its volume converges", "[shape]") {
    skip_if_it_needs_a_file();
    const Values defaults = default_values();
    const std::size_t index = defaults.set.index_of("segments");
    if (index == defaults.set.schema().size()) SKIP("it has no parameter 'segments'");
    if (!declares("closed")) SKIP("only closed shapes have a volume");
    std::vector<double> volumes;
    for (const std::int64_t segments : {8, 16, 32, 64}) {
        Values values = defaults;
        values.set.set(index, segments);
        volumes.push_back(topology_of(mesh_of(values)).volume);
    }
    for (std::size_t i = 2; i < volumes.size(); ++i) {
        if (std::abs(volumes[i] - volumes[i - 1]) > 0.6 * std::abs(volumes[i - 1] - volumes[i - 2]) + 1e-6)
            FAIL("with 8, 16, 32, 64 segments its volume is " << volumes[0] << ", " << volumes[1] << ", "
                                                              << volumes[2] << ", " << volumes[3]
                                                              << ": that does not converge");
    }
}

TEST_CASE("repeatable: the same values yield the same mesh, again and from 4 threads at once", "[shape]") {
    skip_if_it_needs_a_file();
    constexpr std::size_t k_threads = 4;
    std::vector<Values> values = many_values(static_cast<int>(k_threads));
    values.erase(values.begin(), values.end() - k_threads);  // different meshes, if there are any
    std::vector<Mesh> alone;
    for (const Values& one : values) {
        alone.push_back(mesh_of(one));
        if (!is_same(mesh_of(one), alone.back()))
            FAIL("its mesh is different the second time, with " << one.text);
    }
    constexpr int k_rounds = 5;
    constexpr auto k_longest = std::chrono::seconds(2);
    if (!hold_at_once(k_threads, k_rounds, std::chrono::steady_clock::now() + k_longest,
                      [&](std::size_t t) { return is_same(mesh_of(values[t]), alone[t]); }))
        FAIL("its mesh is different while other threads make theirs");
}
