#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/generators/catch_generators.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <cstddef>
#include <utility>

using Catch::Matchers::WithinRel;

TEST_CASE("its volume is that of Jaklic, Leonardis, Solina (2000), eq. 2.60") {
    const auto [polar, around] =
        GENERATE(std::pair(1.0, 1.0), std::pair(2.0, 2.0), std::pair(0.5, 0.5), std::pair(0.3, 1.0));
    const auto shape = candela::sdk::make<candela::Shape>(CANDELA_PLUGIN_DIR, "superquadric",
                                                          {{"width", 2.0},
                                                           {"height", 4.0},
                                                           {"depth", 1.0},
                                                           {"roundness_polar", polar},
                                                           {"roundness_around", around},
                                                           {"segments", std::int64_t{256}}});
    const candela::sdk::Triangles triangles(*shape);
    double six = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        six += double{dot(triangles.corner(t, 0), cross(triangles.corner(t, 1), triangles.corner(t, 2)))};
    // Half axes 1, 2 and 1/2. For e1 = e2 = 1 this is the ellipsoid's 4/3 pi, for 2 the octahedron's 4/3.
    const double volume =
        2 * polar * around * std::beta(polar / 2 + 1, polar) * std::beta(around / 2, around / 2);
    CHECK_THAT(six / 6, WithinRel(volume, 0.01));
}
