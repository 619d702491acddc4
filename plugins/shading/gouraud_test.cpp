#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ShadingModel;
using candela::Vec3;
using candela::Vec3Arrays;

TEST_CASE("shading/gouraud lights vertices with their normals") {
    const auto model = instance<ShadingModel>("gouraud");
    CHECK(model->shading_rate() == candela::ShadingRate::vertex);
    Random random(7);
    each_way([&](std::size_t size) {
        Vec3Arrays face, vertex, weight, result;
        for (Vec3Arrays* arrays : {&face, &vertex, &weight, &result}) arrays->resize(size);
        for (std::size_t i = 0; i < size; ++i) vertex.span().set(i, random.direction());
        model->normals({size, face.span(), vertex.span(), weight.span(), {}, {}, {}}, result.span());
        for (std::size_t i = 0; i < size; ++i) {
            REQUIRE(agree(result.span()[i], vertex.span()[i], 1e-6, 1e-6));
        }
    });
}

TEST_CASE("vertex normals are the normalised sum of the normals of the faces that share the vertex (DD9)") {
    // Three faces of a cube's corner: x, y and z, each a triangle, meet in vertex 0; the others have a face
    // or two.
    const std::vector<Vec3> positions = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
    const std::vector<std::uint32_t> indices = {0, 1, 2, 0, 2, 3, 0, 3, 1};
    const std::vector<Vec3> face_normals = {{0, 0, 1}, {1, 0, 0}, {0, 1, 0}};
    Vec3Arrays position, face, normal;
    position.resize(4);
    face.resize(3);
    normal.resize(4);
    for (std::size_t i = 0; i < 4; ++i) position.span().set(i, positions[i]);
    for (std::size_t i = 0; i < 3; ++i) face.span().set(i, face_normals[i]);
    const std::vector<std::uint32_t> group = {0, 1, 2, 3};
    for (const char* const name : {"flat", "gouraud", "phong"}) {
        instance<ShadingModel>(name)->vertex_normals({position.span(), indices, face.span(), group, 4, 4, {}},
                                                     normal.span());
        const float third = 1 / std::sqrt(3.0f);
        const float half = 1 / std::sqrt(2.0f);
        CHECK(agree(normal.span()[0], Vec3{third, third, third}, 1e-6));
        CHECK(agree(normal.span()[1], Vec3{0, half, half}, 1e-6));
        CHECK(agree(normal.span()[2], Vec3{half, 0, half}, 1e-6));
        CHECK(agree(normal.span()[3], Vec3{half, half, 0}, 1e-6));
    }
}

TEST_CASE("vertices of one smooth group share one normal; those of different groups do not") {
    const std::vector<std::uint32_t> indices = {0, 1, 2, 3, 4, 5};
    Vec3Arrays position, face, normal;
    position.resize(6);
    face.resize(2);
    normal.resize(6);
    face.span().set(0, {1, 0, 0});
    face.span().set(1, {0, 1, 0});
    const std::vector<std::uint32_t> group = {0, 1, 2, 0, 4, 5};
    instance<ShadingModel>("gouraud")->vertex_normals(
        {position.span(), indices, face.span(), group, 6, 6, {}}, normal.span());
    const float half = 1 / std::sqrt(2.0f);
    CHECK(agree(normal.span()[0], Vec3{half, half, 0}, 1e-6));
    CHECK(agree(normal.span()[1], Vec3{1, 0, 0}, 1e-6));
    CHECK(agree(normal.span()[4], Vec3{0, 1, 0}, 1e-6));
}
