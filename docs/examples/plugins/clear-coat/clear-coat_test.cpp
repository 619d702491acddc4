#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::sdk::reflected;
using Catch::Matchers::WithinRel;

TEST_CASE("at normal incidence, a coat of index 1.5 mirrors 4 % and transmits 96 %, twice") {
    const candela::sdk::Reflection parts =
        reflected(CANDELA_PLUGIN_DIR, "clear-coat", {{"kd", 0.5}, {"ior", 1.5}, {"roughness", 0.5}}, 0, 0);
    CHECK_THAT(parts.diffuse.x, WithinRel(0.5 * 0.96 * 0.96, 1e-5));
    // F D G / 4, with D = 1 / alpha^2 and G = 1.
    CHECK_THAT(parts.specular.x, WithinRel(0.04 / 0.25 / 4, 1e-5));
}

TEST_CASE("at 60 degrees on both sides, the ground receives the light that Schlick's formula transmits") {
    const double through = 1 - (0.04 + 0.96 * std::pow(0.5, 5));
    CHECK_THAT(reflected(CANDELA_PLUGIN_DIR, "clear-coat", {{"kd", 1.0}, {"ior", 1.5}}, 60, -60).diffuse.x,
               WithinRel(0.5 * through * through, 1e-5));
}
