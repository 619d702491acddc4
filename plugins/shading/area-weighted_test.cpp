#include <catch2/catch_test_macros.hpp>

#include "support/normals.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ShadingModel;
using candela::Vec3;

TEST_CASE("shading/area-weighted weights a face by its area") {
    check_weighted_normals("area-weighted", [](Double3 p, Double3 q) { return 0.5 * length(cross(p, q)); });
}

TEST_CASE("shading/area-weighted: a vertex inside a fan has the normal of the fan's border, wherever it is") {
    // Twice the sum of the area vectors of triangles (v, p_i, p_i+1) is the sum of p_i x p_i+1: v drops out.
    const std::vector<Vec3> border = {
        {1, 0, 0}, {0.8f, 0.9f, 0.3f}, {-0.7f, 1, -0.2f}, {-1, -0.4f, 0.5f}, {0.1f, -1, 0}};
    Double3 expected;
    for (std::size_t i = 0; i < border.size(); ++i)
        expected = expected + cross(exact(border[i]), exact(border[(i + 1) % border.size()]));
    const auto area = instance<ShadingModel>("area-weighted");
    const auto plain = instance<ShadingModel>("phong");
    double plain_error = 0;
    for (const Vec3 inside :
         {Vec3{0, 0, 0}, Vec3{0.3f, 0.2f, 0.5f}, Vec3{-0.5f, 0.4f, -0.8f}, Vec3{0, 0, 2}}) {
        Polyhedron fan;
        fan.position = border;
        fan.position.push_back(inside);
        for (std::uint32_t i = 0; i < 5; ++i) fan.add(5, i, (i + 1) % 5);
        CHECK(largest_angle({vertex_normals(*area, fan)[5]}, {unit(expected)}) < 1e-6);
        plain_error =
            std::max(plain_error, largest_angle({vertex_normals(*plain, fan)[5]}, {unit(expected)}));
    }
    CHECK(plain_error > 0.05);
}

TEST_CASE("shading/area-weighted: a face four times as large counts four times") {
    Polyhedron roof;
    roof.position = {{0, 0, 0}, {2, 0, 0}, {0, 1, 0}, {0, 0, 0.5f}};
    roof.add(0, 1, 2);  // area 1, normal +z
    roof.add(0, 2, 3);  // area 1/4, normal +x
    CHECK(agree(vertex_normals(*instance<ShadingModel>("area-weighted"), roof)[0], unit(Double3{1, 0, 4}),
                1e-6));
}

TEST_CASE("shading/area-weighted handles triangles without area, smooth groups and authored normals") {
    check_normals_of_odd_meshes("area-weighted");
}

TEST_CASE("shading/area-weighted normalises the interpolated vertex normal at every fragment (DD10)") {
    check_interpolated_normals("area-weighted");
}
