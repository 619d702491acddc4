#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

using Catch::Matchers::WithinAbs;

TEST_CASE("two metres away, a quarter of the light arrives, from the light's position") {
    const auto light = candela::sdk::make<candela::Light>(
        CANDELA_PLUGIN_DIR, "@NAME@", {{"position", candela::Vec3{0, 2, 0}}, {"intensity", 3.0}});

    const float zero = 0, one = 1;
    float out[9] = {};
    light->illuminate(0, {.count = 1, .position = {&zero, &zero, &zero}, .normal = {&zero, &one, &zero}},
                      {.to_light = {out, out + 1, out + 2}, .diffuse = {out + 3, out + 4, out + 5}, .specular = {out + 6, out + 7, out + 8}});
    CHECK(out[1] == 1);
    CHECK_THAT(out[3], WithinAbs(0.75, 1e-6));
}
