#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

import candela.core;

using Catch::Matchers::WithinAbs;

TEST_CASE("light from 60 degrees off the normal: half of kd is reflected") {
    candela::Registry registry({CANDELA_PLUGIN_DIR});
    candela::ParamSet values = registry.parameters(candela::PluginKind::reflection, "@NAME@");
    values.set("kd", 0.8);
    const auto model = registry.create<candela::ReflectionModel>("@NAME@", values, candela::ColorEncoding::none);

    const float zero = 0, one = 1, half = 0.5f, sine = std::sqrt(0.75f);
    float out[9] = {};
    model->reflect({.count = 1, .normal = {&zero, &one, &zero}, .to_observer = {&zero, &one, &zero}, .tangent = {}, .color = {1, 1, 1}},
                   {.to_light = {&sine, &half, &zero}, .diffuse = {&one, &one, &one}, .specular = {&one, &one, &one}},
                   {.ambient = {out, out + 1, out + 2}, .diffuse = {out + 3, out + 4, out + 5}, .specular = {out + 6, out + 7, out + 8}});
    CHECK_THAT(out[3], WithinAbs(0.4, 1e-6));
}
