#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ShadingModel;
using candela::Vec3;
using candela::Vec3Arrays;

TEST_CASE("shading/flat uses the face's normal, once per face (DD8)") {
    const auto model = instance<ShadingModel>("flat");
    CHECK(model->shading_rate() == candela::ShadingRate::face);
    Random random(5);
    each_way([&](std::size_t size) {
        Vec3Arrays face, vertex, weight, result;
        for (Vec3Arrays* arrays : {&face, &vertex, &weight, &result}) arrays->resize(size);
        for (std::size_t i = 0; i < size; ++i) {
            face.span().set(i, random.direction());
            vertex.span().set(i, random.direction());
        }
        model->normals({size, face.span(), vertex.span(), weight.span(), {}, {}, {}}, result.span());
        for (std::size_t i = 0; i < size; ++i) REQUIRE(result.span()[i] == face.span()[i]);
    });
}
