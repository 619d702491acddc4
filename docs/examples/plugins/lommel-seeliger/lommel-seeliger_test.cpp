#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::sdk::reflected;
using Catch::Matchers::WithinRel;

TEST_CASE(
    "the full moon is flat: lit from the observer's direction, it reflects an eighth of the albedo "
    "everywhere") {
    for (const float angle : {0.0f, 30.0f, 60.0f, 85.0f})
        CHECK_THAT(
            reflected(CANDELA_PLUGIN_DIR, "lommel-seeliger", {{"albedo", 0.8}}, angle, angle).diffuse.x,
            WithinRel(0.1, 1e-5));
}

TEST_CASE("seen along the normal and lit from 60 degrees, it reflects w / 4 times a third") {
    CHECK_THAT(reflected(CANDELA_PLUGIN_DIR, "lommel-seeliger", {{"albedo", 0.6}}, 0, 60).diffuse.x,
               WithinRel(0.05, 1e-5));
}
