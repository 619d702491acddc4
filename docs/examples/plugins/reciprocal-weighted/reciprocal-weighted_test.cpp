#include <candela/plugin_test.h>

#include <array>
#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <cstdint>

using Catch::Matchers::WithinAbs;

TEST_CASE(
    "at a corner with edges of 1, 2 and 4, each face's weight is the reciprocal of the product of its "
    "edges") {
    const auto model = candela::sdk::make<candela::ShadingModel>(CANDELA_PLUGIN_DIR, "reciprocal-weighted");

    // A tetrahedron's corner: edges along x, y and z. The faces point along -z, -x and -y.
    const std::array<float, 4> x{0, 1, 0, 0}, y{0, 0, 2, 0}, z{0, 0, 0, 4};
    const std::array<std::uint32_t, 9> indices{0, 2, 1, 0, 3, 2, 0, 1, 3};
    const std::array<float, 3> face_x{0, -1, 0}, face_y{0, 0, -1}, face_z{-1, 0, 0};
    const std::array<std::uint32_t, 4> group{0, 1, 2, 3};
    std::array<float, 4> out_x{}, out_y{}, out_z{};
    candela::MeshView mesh;
    mesh.vertex_count = 4;
    mesh.position = {x.data(), y.data(), z.data()};
    mesh.indices = indices;
    mesh.face_normal = {face_x.data(), face_y.data(), face_z.data()};
    mesh.smooth_group = group;
    mesh.group_count = 4;
    model->vertex_normals(mesh, {out_x.data(), out_y.data(), out_z.data()});

    // 1 / (1 * 2), 1 / (2 * 4) and 1 / (4 * 1), of length sqrt(21) / 8.
    CHECK_THAT(out_z[0], WithinAbs(-4 / std::sqrt(21.0), 1e-5));
    CHECK_THAT(out_x[0], WithinAbs(-1 / std::sqrt(21.0), 1e-5));
    CHECK_THAT(out_y[0], WithinAbs(-2 / std::sqrt(21.0), 1e-5));
}
