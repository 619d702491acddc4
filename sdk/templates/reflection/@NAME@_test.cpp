#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>

using Catch::Matchers::WithinAbs;

TEST_CASE("light from 60 degrees off the normal: half of kd is reflected") {
    const auto parts = candela::sdk::reflected(CANDELA_PLUGIN_DIR, "@NAME@", {{"kd", 0.8}}, 0, 60);
    CHECK_THAT(parts.diffuse.x, WithinAbs(0.4, 1e-6));
}
