#include <candela/plugin_test.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::Vec3;
using Catch::Matchers::WithinAbs;

namespace {

/// A triangle with the edges (2, 0, 0) and (0, 1, 0) in the plane z = 0.
struct Corners {
    std::array<Vec3, 3> position{Vec3{0, 0, 0}, Vec3{2, 0, 0}, Vec3{0, 1, 0}};
    std::array<Vec3, 3> normal;
};

Vec3 normal_at(const Corners& corners, Vec3 barycentric) {
    const auto model = candela::sdk::make<candela::ShadingModel>(CANDELA_PLUGIN_DIR, "pn-normals");
    const auto span = [](const Vec3& v) { return candela::ConstVec3Span{&v.x, &v.y, &v.z}; };
    candela::TriangleBatch triangle;
    for (std::size_t k = 0; k < 3; ++k) {
        triangle.position[k] = span(corners.position[k]);
        triangle.normal[k] = span(corners.normal[k]);
    }
    const Vec3 face{0, 0, 1};
    const Vec3 interpolated = barycentric.x * corners.normal[0] + barycentric.y * corners.normal[1] +
                              barycentric.z * corners.normal[2];
    candela::ShadingPointBatch point;
    point.count = 1;
    point.face_normal = span(face);
    point.vertex_normal = span(interpolated);
    point.barycentric = span(barycentric);
    point.triangle = &triangle;
    Vec3 normal;
    model->normals(point, {&normal.x, &normal.y, &normal.z});
    return normal;
}

void check_normal(Vec3 n, double x, double y, double z) {
    CHECK_THAT(n.x, WithinAbs(x, 1e-6));
    CHECK_THAT(n.y, WithinAbs(y, 1e-6));
    CHECK_THAT(n.z, WithinAbs(z, 1e-6));
}

}  // namespace

TEST_CASE("at its vertices, a triangle has their normals") {
    const Corners corners{.normal = {Vec3{0.6f, 0, 0.8f}, Vec3{0, 0.6f, 0.8f}, Vec3{0, -0.8f, 0.6f}}};
    check_normal(normal_at(corners, {1, 0, 0}), 0.6, 0, 0.8);
    check_normal(normal_at(corners, {0, 1, 0}), 0, 0.6, 0.8);
    check_normal(normal_at(corners, {0, 0, 1}), 0, -0.8, 0.6);
}

TEST_CASE(
    "between two equal normals that lean along the edge, the surface is an S, which interpolation misses") {
    // N_12 = (0.6, 0, 0.8) mirrored along x. At the middle 1/4 N + 1/4 N + 1/4 N_12 = (0.15, 0, 0.6), of the
    // length 0.15 sqrt(17), where interpolation says (0.6, 0, 0.8) all along.
    const Vec3 leaning{0.6f, 0, 0.8f};
    const Corners corners{.normal = {leaning, leaning, leaning}};
    check_normal(normal_at(corners, {0.5f, 0.5f, 0}), 1 / std::sqrt(17.0), 0, 4 / std::sqrt(17.0));
    // The edge from the third vertex to the first is perpendicular to it: nothing is mirrored.
    check_normal(normal_at(corners, {0.5f, 0, 0.5f}), 0.6, 0, 0.8);
}

TEST_CASE("between normals that lean apart, the coefficient of the edge is their normalised sum") {
    // N_1 + N_2 = (0, 0, 1.6) is perpendicular to the edge. At b = (3/4, 1/4, 0): 9/16 N_1 + 1/16 N_2 + 3/16
    // z = (-0.3, 0, 0.6875).
    const Corners corners{.normal = {Vec3{-0.6f, 0, 0.8f}, Vec3{0.6f, 0, 0.8f}, Vec3{0, 0, 1}}};
    const double length = std::hypot(0.3, 0.6875);
    check_normal(normal_at(corners, {0.75f, 0.25f, 0}), -0.3 / length, 0, 0.6875 / length);
}

TEST_CASE("inside a triangle, all six coefficients count") {
    // At the centroid (N_1 + N_2 + N_3 + N_12 + N_23 + N_31) / 9 with N_1 = N_2 = z and N_3 = (0, 0.6, 0.8):
    // N_12 = z; N_31 = (0, 0.6, 1.8) mirrored along y = (0, -0.6, 1.8) / sqrt(3.6); and N_23 the same sum
    // mirrored along (-2, 1, 0), v = 2 * 0.6 / 5 = 0.24: (0.48, 0.36, 1.8) / sqrt(3.6).
    const Corners corners{.normal = {Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 0.6f, 0.8f}}};
    const double edge = std::sqrt(3.6);
    const double x = 0.48 / edge, y = 0.6 + (0.36 - 0.6) / edge, z = 3.8 + 3.6 / edge;
    const double length = std::sqrt(x * x + y * y + z * z);
    const float third = 1.0f / 3.0f;
    check_normal(normal_at(corners, {third, third, third}), x / length, y / length, z / length);
}

TEST_CASE("if two vertices coincide, the normals are those of the vertices") {
    Corners corners{.normal = {Vec3{0, 0, 1}, Vec3{0, 0, 1}, Vec3{0, 0, 1}}};
    corners.position[1] = corners.position[0];
    check_normal(normal_at(corners, {0.2f, 0.3f, 0.5f}), 0, 0, 1);
}
