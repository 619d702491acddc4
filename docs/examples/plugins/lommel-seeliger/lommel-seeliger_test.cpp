#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <initializer_list>

using Catch::Matchers::WithinRel;

namespace {

/// Both angles in degrees from the normal.
candela::sdk::Reflection reflected(std::initializer_list<candela::Setting> settings, float observer,
                                   float light) {
    const auto model =
        candela::sdk::make<candela::ReflectionModel>(CANDELA_PLUGIN_DIR, "lommel-seeliger", settings);
    return candela::sdk::reflected(*model, observer, light);
}

}  // namespace

TEST_CASE("the full moon is flat: lit from where it is seen, an eighth of the albedo everywhere") {
    for (const float angle : {0.0f, 30.0f, 60.0f, 85.0f})
        CHECK_THAT(reflected({{"albedo", 0.8}}, angle, angle).diffuse.x, WithinRel(0.1, 1e-5));
}

TEST_CASE("seen straight on and lit from 60 degrees: w / 4 of a third") {
    CHECK_THAT(reflected({{"albedo", 0.6}}, 0, 60).diffuse.x, WithinRel(0.05, 1e-5));
}
