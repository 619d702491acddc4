#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>

using candela::sdk::reflected;
using Catch::Matchers::WithinRel;

TEST_CASE("c = (-1, -1, 1) is Phong's lobe: the power of the cosine between observer and mirror direction") {
    const double lobe = std::cos(10 * 0.0174532925);
    CHECK_THAT(
        reflected(CANDELA_PLUGIN_DIR, "lafortune", {{"ks", 0.3}, {"exponent", 20.0}}, -40, 30).specular.x,
        WithinRel(0.3 * 11 * std::pow(lobe, 20) * std::cos(30 * 0.0174532925), 1e-4));
}

TEST_CASE("c = (1, 1, 1) reflects light back to its source") {
    const auto back = [](float observer) {
        return reflected(CANDELA_PLUGIN_DIR, "lafortune", {{"c_xy", 1.0}, {"c_z", 1.0}}, observer, 50)
            .specular.x;
    };
    CHECK(back(50) > 1.2f * back(40));
    CHECK(back(50) > 1.2f * back(60));
    CHECK_THAT(back(50), WithinRel(0.3 * 11 * std::cos(50 * 0.0174532925), 1e-4));
}
