#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cstddef>
#include <numbers>

using Catch::Matchers::WithinRel;

TEST_CASE("its volume is nearly that of the ellipsoid, pi / 6 times width^2 height") {
    const auto shape = candela::sdk::make<candela::Shape>(CANDELA_PLUGIN_DIR, "@NAME@");
    const candela::sdk::Triangles triangles(*shape);
    float six = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        six += dot(triangles.corner(t, 0), cross(triangles.corner(t, 1), triangles.corner(t, 2)));
    CHECK_THAT(six / 6, WithinRel(std::numbers::pi / 6 * 1.4, 0.01));
}
