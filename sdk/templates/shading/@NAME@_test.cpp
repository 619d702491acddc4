#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using Catch::Matchers::WithinAbs;

TEST_CASE("between a face that points up and a vertex normal along x, the normal is the diagonal") {
    const auto model = candela::sdk::make<candela::ShadingModel>(CANDELA_PLUGIN_DIR, "@NAME@");

    const float zero = 0, one = 1;
    float out[3] = {};
    model->normals({.count = 1,
                    .face_normal = {&zero, &one, &zero},
                    .vertex_normal = {&one, &zero, &zero},
                    .barycentric = {&one, &zero, &zero},
                    .uv = {},
                    .dpdu = {},
                    .dpdv = {}},
                   {out, out + 1, out + 2});
    CHECK_THAT(out[0], WithinAbs(std::sqrt(0.5), 1e-6));
    CHECK_THAT(out[1], WithinAbs(std::sqrt(0.5), 1e-6));
    CHECK(out[2] == 0);
}
