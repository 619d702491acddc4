#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/normals.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ShadingModel;
using candela::Vec3;

namespace {

/// A cube with eight vertices whose six faces are split along one diagonal or the other, according to the
/// bits of `cuts`.
Polyhedron cut_cube(unsigned cuts) {
    Polyhedron cube;
    for (const float x : {-1.0f, 1.0f}) {
        for (const float y : {-1.0f, 1.0f}) {
            for (const float z : {-1.0f, 1.0f}) cube.position.push_back({x, y, z});
        }
    }
    // Counter-clockwise seen from outside; vertex = 4 [x > 0] + 2 [y > 0] + [z > 0].
    constexpr std::uint32_t k_faces[6][4] = {{4, 6, 7, 5}, {0, 1, 3, 2}, {2, 3, 7, 6},
                                             {0, 4, 5, 1}, {1, 5, 7, 3}, {0, 2, 6, 4}};
    for (unsigned f = 0; f < 6; ++f) {
        const auto& q = k_faces[f];
        const unsigned shift = (cuts >> f) & 1;
        const auto at = [&](unsigned k) { return q[(k + shift) % 4]; };
        cube.add(at(0), at(1), at(2));
        cube.add(at(0), at(2), at(3));
    }
    return cube;
}

std::vector<Double3> diagonals(const Polyhedron& cube) {
    std::vector<Double3> result;
    for (const Vec3 p : cube.position) result.push_back(unit(exact(p)));
    return result;
}

/// The corner of a cube whose three faces are split there into 1, 2 and 5 triangles of unequal size.
Polyhedron uneven_corner() {
    Polyhedron corner;
    corner.position = {{0, 0, 0}};
    const std::vector<std::vector<double>> cuts = {{0, 90}, {0, 11, 90}, {0, 3, 8, 40, 77, 90}};
    for (std::size_t axis = 0; axis < 3; ++axis) {
        // From one negative axis to the next, so that the normal is the third positive one.
        for (std::size_t i = 0; i < cuts[axis].size(); ++i) {
            const double angle = cuts[axis][i] * std::numbers::pi / 180;
            float p[3] = {0, 0, 0};
            p[(axis + 1) % 3] = static_cast<float>(-std::cos(angle));
            p[(axis + 2) % 3] = static_cast<float>(-std::sin(angle));
            corner.position.push_back({p[0], p[1], p[2]});
            const auto last = static_cast<std::uint32_t>(corner.position.size() - 1);
            if (i > 0) corner.add(0, last - 1, last);
        }
    }
    return corner;
}

}  // namespace

TEST_CASE("shading/angle-weighted weights a face by its angle at the vertex (Thuermer, Wuethrich 1998)") {
    check_weighted_normals("angle-weighted", [](Double3 p, Double3 q) {
        return std::acos(std::clamp(dot(unit(p), unit(q)), -1.0, 1.0));
    });
}

TEST_CASE(
    "shading/angle-weighted: the corners of a cube point along its diagonals, however its faces are cut") {
    const auto weighted = instance<ShadingModel>("angle-weighted");
    const auto plain = instance<ShadingModel>("phong");
    double worst = 0, worst_plain = 0;
    for (unsigned cuts = 0; cuts < 64; ++cuts) {
        const Polyhedron cube = cut_cube(cuts);
        worst = std::max(worst, largest_angle(vertex_normals(*weighted, cube), diagonals(cube)));
        worst_plain = std::max(worst_plain, largest_angle(vertex_normals(*plain, cube), diagonals(cube)));
    }
    CHECK(worst < 1e-6);
    // One of three faces counts twice: the angle between (1, 1, 1) and (1, 1, 2).
    CHECK(agree(worst_plain, std::acos(4 / std::sqrt(18.0)), 1e-5));

    const Polyhedron corner = uneven_corner();
    const Double3 diagonal = unit(Double3{1, 1, 1});
    CHECK(largest_angle({vertex_normals(*weighted, corner)[0]}, {diagonal}) < 1e-6);
    CHECK(largest_angle({vertex_normals(*plain, corner)[0]}, {unit(Double3{1, 2, 5})}) < 1e-6);
}

TEST_CASE("shading/angle-weighted handles triangles without area, smooth groups and authored normals") {
    check_normals_of_odd_meshes("angle-weighted");
}

TEST_CASE("shading/angle-weighted normalises the interpolated vertex normal at every fragment (DD10)") {
    check_interpolated_normals("angle-weighted");
}
