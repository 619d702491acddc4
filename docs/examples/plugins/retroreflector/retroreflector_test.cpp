#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::sdk::reflected;
using Catch::Matchers::WithinRel;

TEST_CASE("the observer at the light sees the returned beam, ks N.L") {
    CHECK_THAT(reflected(CANDELA_PLUGIN_DIR, "retroreflector", {{"ks", 0.5}}, 60, 60).specular.x,
               WithinRel(0.25, 1e-4));
}

TEST_CASE("60 degrees from the light, half to the power of the sharpness is left") {
    CHECK_THAT(
        reflected(CANDELA_PLUGIN_DIR, "retroreflector", {{"ks", 1.0}, {"sharpness", 3.0}}, 60, 0).specular.x,
        WithinRel(0.125, 1e-4));
}

TEST_CASE("the mirror image is dark") {
    CHECK(reflected(CANDELA_PLUGIN_DIR, "retroreflector", {}, -60, 60).specular.x < 1e-6f);
}
