#include "support/normals.h"

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <numeric>

#include "support/plugins.h"

using candela::ShadingModel;
using candela::Vec3;
using candela::Vec3Arrays;

namespace {

Vec3Arrays arrays_of(const std::vector<Vec3>& vectors) {
    Vec3Arrays arrays;
    arrays.resize(vectors.size());
    for (std::size_t i = 0; i < vectors.size(); ++i) arrays.span().set(i, vectors[i]);
    return arrays;
}

std::array<Double3, 3> corners_of(const Polyhedron& body, std::size_t triangle) {
    const auto at = [&](std::size_t k) { return exact(body.position[body.indices[3 * triangle + k]]); };
    return {at(0), at(1), at(2)};
}

Double3 face_normal(const Polyhedron& body, std::size_t triangle) {
    const auto [a, b, c] = corners_of(body, triangle);
    return unit_or_zero(cross(b - a, c - a));
}

std::vector<Vec3> vertex_normals(const ShadingModel& model, const Polyhedron& body,
                                 const std::vector<std::uint32_t>& group, const std::vector<Vec3>& authored) {
    std::vector<Vec3> faces;
    for (std::size_t t = 0; t < body.triangles(); ++t) faces.push_back(rounded(face_normal(body, t)));
    Vec3Arrays position = arrays_of(body.position), face = arrays_of(faces), given = arrays_of(authored),
               normal;
    normal.resize(body.position.size());
    model.vertex_normals({position.span(), body.indices, face.span(), group, body.position.size(),
                          body.position.size(), given.empty() ? candela::ConstVec3Span{} : given.span()},
                         normal.span());
    std::vector<Vec3> result;
    for (const std::uint32_t g : group) result.push_back(normal.span()[g]);
    return result;
}

std::vector<std::uint32_t> own_groups(const Polyhedron& body) {
    std::vector<std::uint32_t> group(body.position.size());
    std::iota(group.begin(), group.end(), 0u);
    return group;
}

/// Random triangles over a few vertices, none of them a needle.
Polyhedron random_body(std::size_t triangles, Random& random) {
    Polyhedron body;
    const std::size_t vertices = 3 + triangles / 3;
    for (std::size_t i = 0; i < vertices; ++i) body.position.push_back(random.point(1));
    const auto any = [&] {
        return std::min(static_cast<std::uint32_t>(random.number(0, static_cast<double>(vertices))),
                        static_cast<std::uint32_t>(vertices - 1));
    };
    while (body.triangles() < triangles) {
        const std::uint32_t a = any(), b = any(), c = any();
        if (a == b || b == c || c == a) continue;
        const Double3 p = exact(body.position[a]), q = exact(body.position[b]), r = exact(body.position[c]);
        const auto sine = [](Double3 u, Double3 v) { return length(cross(u, v)) / (length(u) * length(v)); };
        const double sharpest = std::min({sine(q - p, r - p), sine(r - q, p - q), sine(p - r, q - r)});
        const double shortest = std::min({length(q - p), length(r - q), length(p - r)});
        if (vertices == 3 || (sharpest > 0.1 && shortest > 0.2)) body.add(a, b, c);
    }
    return body;
}

struct WeightedSum {
    Double3 sum;
    double weights = 0;
    /// If the faces nearly cancel, rounding decides.
    bool is_clear() const { return length(sum) > 0.1 * weights; }
};

std::vector<WeightedSum> weighted_sums(const Polyhedron& body, const CornerWeight& weight) {
    std::vector<WeightedSum> sums(body.position.size());
    for (std::size_t t = 0; t < body.triangles(); ++t) {
        const auto p = corners_of(body, t);
        for (std::size_t k = 0; k < 3; ++k) {
            WeightedSum& s = sums[body.indices[3 * t + k]];
            const double w = weight(p[(k + 1) % 3] - p[k], p[(k + 2) % 3] - p[k]);
            s.sum = s.sum + w * face_normal(body, t);
            s.weights += w;
        }
    }
    return sums;
}

/// Compares the normals where the sum is clear; `turned` is applied to the expected ones, `renumbered` maps
/// the vertices.
void check_against(const std::vector<Vec3>& normals, const std::vector<WeightedSum>& sums,
                   const std::function<Double3(Double3)>& turned,
                   const std::vector<std::uint32_t>& renumbered) {
    for (std::size_t v = 0; v < sums.size(); ++v) {
        if (!sums[v].is_clear()) continue;
        const Double3 expected = turned(unit(sums[v].sum));
        INFO("vertex " << v << ": " << text(normals[renumbered[v]]) << ", expected " << text(expected));
        REQUIRE(agree(normals[renumbered[v]], expected, 2e-5, 2e-5));
    }
}

Double3 same(Double3 v) { return v; }

/// A rotation by a third of a turn about (1, 1, 1), then by 0.7 radians about z.
Double3 turned(Double3 v) {
    const Double3 w{v.z, v.x, v.y};
    const double c = std::cos(0.7), s = std::sin(0.7);
    return {c * w.x - s * w.y, s * w.x + c * w.y, w.z};
}

Polyhedron mapped(Polyhedron body, const std::function<Double3(Double3)>& map) {
    for (Vec3& p : body.position) p = rounded(map(exact(p)));
    return body;
}

/// The same surface with its vertices renumbered, its triangles in another order, and each starting at
/// another corner.
Polyhedron reordered(const Polyhedron& body, const std::vector<std::uint32_t>& renumbered) {
    Polyhedron result;
    result.position.resize(body.position.size());
    for (std::size_t v = 0; v < body.position.size(); ++v) result.position[renumbered[v]] = body.position[v];
    for (std::size_t t = body.triangles(); t-- > 0;) {
        const auto at = [&](std::size_t k) { return renumbered[body.indices[3 * t + (k + t) % 3]]; };
        result.add(at(0), at(1), at(2));
    }
    return result;
}

}  // namespace

Double3 unit_or_zero(Double3 v) { return length(v) > 0 ? unit(v) : Double3{}; }

std::vector<Vec3> vertex_normals(const ShadingModel& model, const Polyhedron& body) {
    return vertex_normals(model, body, own_groups(body), {});
}

double largest_angle(const std::vector<Vec3>& normals, const std::vector<Double3>& expected) {
    REQUIRE(normals.size() == expected.size());
    double largest = 0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
        const Double3 n = exact(normals[i]);
        largest = std::max(largest, std::atan2(length(cross(n, expected[i])), dot(n, expected[i])));
    }
    return largest;
}

void check_weighted_normals(std::string_view name, const CornerWeight& weight) {
    const auto model = instance<ShadingModel>(name);
    each_way([&](std::size_t size) {
        Random random(static_cast<unsigned>(size));
        const Polyhedron body = random_body(size, random);
        const std::vector<WeightedSum> sums = weighted_sums(body, weight);
        REQUIRE(std::ranges::any_of(sums, &WeightedSum::is_clear));
        std::vector<std::uint32_t> order = own_groups(body);
        check_against(vertex_normals(*model, body), sums, same, order);
        const auto moved = [](Double3 p) { return turned(p) + Double3{1, -2, 0.5}; };
        check_against(vertex_normals(*model, mapped(body, moved)), sums, turned, order);
        for (const double scale : {1e-15, 1e15}) {
            const Polyhedron scaled = mapped(body, [&](Double3 p) { return scale * p; });
            check_against(vertex_normals(*model, scaled), sums, same, order);
        }
        std::ranges::reverse(order);
        std::ranges::rotate(order, order.begin() + static_cast<std::ptrdiff_t>(order.size() / 3));
        check_against(vertex_normals(*model, reordered(body, order)), sums, same, order);
    });
}

void check_normals_of_odd_meshes(std::string_view name) {
    const auto model = instance<ShadingModel>(name);
    // One good triangle; a corner twice; three corners on a line; two corners at one place; all corners at
    // one place; and two vertices without triangles.
    Polyhedron body;
    body.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {2, 0, 0}, {1, 0, 0},
                     {5, 5, 5}, {5, 5, 5}, {5, 5, 5}, {7, 7, 7}, {1e-20f, 1e-20f, 0}};
    body.add(0, 1, 2);
    body.add(0, 1, 1);
    body.add(0, 1, 3);
    body.add(2, 1, 4);
    body.add(5, 6, 7);
    body.add(0, 9, 2);
    for (const float scale : {1e-30f, 1e-18f, 1.0f, 1e18f, 1e30f}) {
        INFO("scale " << scale);
        const auto scaled = [&](Double3 p) { return static_cast<double>(scale) * p; };
        const std::vector<Vec3> normals = vertex_normals(*model, mapped(body, scaled));
        for (const std::size_t v : {0u, 1u, 2u}) {
            INFO("vertex " << v);
            CHECK(agree(normals[v], Vec3{0, 0, 1}, 1e-6, 1e-6));
        }
        for (const Vec3 n : normals) CHECK((n == Vec3{} || agree(length(exact(n)), 1, 1e-6)));
    }

    Polyhedron roof;
    roof.position = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    roof.add(0, 1, 2);  // +z
    roof.add(3, 4, 5);  // +x
    const std::vector<Vec3> together = vertex_normals(*model, roof, {0, 1, 2, 0, 2, 5}, {});
    const double half = std::sqrt(0.5);
    CHECK(agree(together[0], Double3{half, 0, half}, 1e-6));
    CHECK(agree(together[3], Double3{half, 0, half}, 1e-6));
    CHECK(agree(together[4], Double3{half, 0, half}, 1e-6));
    CHECK(agree(together[1], Double3{0, 0, 1}, 1e-6));
    CHECK(agree(together[5], Double3{1, 0, 0}, 1e-6));

    const std::vector<Vec3> authored(6, Vec3{0, 1, 0});
    CHECK(vertex_normals(*model, roof, own_groups(roof), authored) == authored);
}

void check_interpolated_normals(std::string_view name) {
    const auto model = instance<ShadingModel>(name);
    CHECK(model->shading_rate() == candela::ShadingRate::fragment);
    Random random(6);
    each_way([&](std::size_t size) {
        Vec3Arrays face, vertex, weight, result;
        for (Vec3Arrays* arrays : {&face, &vertex, &weight, &result}) arrays->resize(size);
        for (std::size_t i = 0; i < size; ++i) {
            face.span().set(i, random.direction());
            vertex.span().set(i, static_cast<float>(random.number(0.1, 1)) * random.direction());
        }
        model->normals({size, face.span(), vertex.span(), weight.span(), {}, {}, {}}, result.span());
        for (std::size_t i = 0; i < size; ++i)
            REQUIRE(agree(result.span()[i], unit(exact(vertex.span()[i])), 1e-6, 1e-6));
    });
}
