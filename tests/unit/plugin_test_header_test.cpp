// candela/plugin_test.h, with which tests of plugins are written.
#include "candela/plugin_test.h"
#include "support/text.h"

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <catch2/matchers/catch_matchers_string.hpp>

using Catch::Matchers::ContainsSubstring;

TEST_CASE("a plugin's test gets an instance as from a host: with defaults, and values as in a scene") {
    const auto light = candela::sdk::make<candela::Light>(
        CANDELA_TEST_PLUGINS, "point", {{"position", candela::Vec3{0, 2, 0}}, {"intensity", 3.0}});
    const float zero = 0, one = 1;
    float out[9] = {};
    light->illuminate(0, {.count = 1, .position = {&zero, &zero, &zero}, .normal = {&zero, &one, &zero}},
                      {.to_light = {out, out + 1, out + 2},
                       .diffuse = {out + 3, out + 4, out + 5},
                       .specular = {out + 6, out + 7, out + 8}});
    CHECK(out[1] == 1);
    CHECK(out[3] == 0.75f);  // a default colour, white, and the inverse square
}

TEST_CASE("a plugin's test gets the same message about invalid settings as a user") {
    CHECK_THAT(message_of([] { candela::sdk::make<candela::Light>(CANDELA_TEST_PLUGINS, "point"); }),
               ContainsSubstring("position"));
    CHECK_THAT(message_of([] {
                   candela::sdk::make<candela::Light>(CANDELA_TEST_PLUGINS, "ambient", {{"intensity", -1.0}});
               }),
               ContainsSubstring("at least 0"));
    CHECK_THAT(message_of([] { candela::sdk::make<candela::Shape>(CANDELA_TEST_PLUGINS, "point"); }),
               ContainsSubstring("no shape plugin is called 'point'"));
}

TEST_CASE("a plugin's test gets a model's reflection in one line") {
    // At 60 degrees, half of the light arrives.
    const candela::sdk::Reflection parts =
        candela::sdk::reflected(CANDELA_TEST_PLUGINS, "lambert", {{"ka", 0.25}, {"kd", 0.5}}, 0, 60);
    CHECK_THAT(parts.diffuse.x, Catch::Matchers::WithinAbs(0.25, 1e-6));
    CHECK(parts.specular == candela::Vec3{});
}

TEST_CASE("a plugin's test gets the triangles of a shape") {
    const auto cube = candela::sdk::make<candela::Shape>(CANDELA_TEST_PLUGINS, "cube");
    const candela::sdk::Triangles triangles(*cube);
    REQUIRE(triangles.size() == 12);
    float six = 0;
    for (std::size_t t = 0; t < triangles.size(); ++t)
        six += dot(triangles.corner(t, 0), cross(triangles.corner(t, 1), triangles.corner(t, 2)));
    CHECK(six == 6);  // a cube of one metre
}
