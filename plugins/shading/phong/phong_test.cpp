#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ShadingModel;
using candela::Vec3Arrays;

TEST_CASE("shading/phong normalises the interpolated vertex normal at every fragment (DD10)") {
    const auto model = instance<ShadingModel>("phong");
    CHECK(model->lighting_rate() == candela::LightingRate::fragment);
    Random random(6);
    each_way([&](std::size_t size) {
        Vec3Arrays face, vertex, weight, result;
        for (Vec3Arrays* arrays : {&face, &vertex, &weight, &result}) arrays->resize(size);
        for (std::size_t i = 0; i < size; ++i) {
            face.span().set(i, random.direction());
            vertex.span().set(i, static_cast<float>(random.number(0.1, 1)) * random.direction());
        }
        model->normals({size, face.span(), vertex.span(), weight.span(), {}, {}, {}}, result.span());
        for (std::size_t i = 0; i < size; ++i) {
            REQUIRE(agree(result.span()[i], unit(exact(vertex.span()[i])), 1e-6, 1e-6));
        }
    });
}
