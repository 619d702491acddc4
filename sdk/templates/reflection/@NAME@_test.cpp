#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using Catch::Matchers::WithinAbs;

TEST_CASE("light from 60 degrees off the normal: half of kd is reflected") {
    const auto model = candela::sdk::make<candela::ReflectionModel>(CANDELA_PLUGIN_DIR, "@NAME@", {{"kd", 0.8}});

    const float zero = 0, one = 1, half = 0.5f, sine = std::sqrt(0.75f);
    float out[9] = {};
    model->reflect({.count = 1, .normal = {&zero, &one, &zero}, .to_observer = {&zero, &one, &zero}, .tangent = {}, .color = {1, 1, 1}},
                   {.to_light = {&sine, &half, &zero}, .diffuse = {&one, &one, &one}, .specular = {&one, &one, &one}},
                   {.ambient = {out, out + 1, out + 2}, .diffuse = {out + 3, out + 4, out + 5}, .specular = {out + 6, out + 7, out + 8}});
    CHECK_THAT(out[3], WithinAbs(0.4, 1e-6));
}
