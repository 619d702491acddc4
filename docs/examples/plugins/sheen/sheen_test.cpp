#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::sdk::reflected;
using Catch::Matchers::WithinRel;

TEST_CASE("roughness 1/2, seen along the normal and lit from 60 degrees: pi D = 1/2, times 1/4, times 1/2") {
    // The half-way vector is at 30 degrees: (2 + 2) sin^2 / 2 = 1/2; N.L + N.V - N.L N.V = 1.
    CHECK_THAT(reflected(CANDELA_PLUGIN_DIR, "sheen", {{"ks", 1.0}, {"roughness", 0.5}}, 0, 60).specular.x,
               WithinRel(0.5 * 0.25 * 0.5, 1e-4));
}

TEST_CASE("lit and seen along the normal, it has no sheen") {
    CHECK(reflected(CANDELA_PLUGIN_DIR, "sheen", {{"ks", 1.0}}, 0, 0).specular.x < 1e-6f);
}

TEST_CASE("its fibres cover the surface: D cos, over the hemisphere, is 1") {
    // With N.V = 1 the visibility is 1/4 and H is halfway, so D is the reflection divided by the other
    // factors.
    double covered = 0;
    for (int i = 0; i < 900; ++i) {
        const double degrees = (i + 0.5) / 10, theta = degrees * 0.017453292519943295;
        if (degrees >= 44.9) break;
        const double at = reflected(CANDELA_PLUGIN_DIR, "sheen", {{"ks", 1.0}, {"roughness", 1.0}}, 0,
                                    static_cast<float>(2 * degrees))
                              .specular.x;
        covered +=
            at * 4 / std::cos(2 * theta) * std::cos(theta) * std::sin(theta) * 2 * 0.0017453292519943295;
    }
    // With pi D = 3/2 sin and H within 45 degrees: 3 times the integral of sin^2 cos, sin^3(44.9
    // degrees).
    CHECK_THAT(covered, WithinRel(std::pow(std::sin(44.9 * 0.017453292519943295), 3), 2e-3));
}
