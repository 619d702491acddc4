#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <initializer_list>

using Catch::Matchers::WithinRel;

namespace {

struct Parts {
    float diffuse, specular;
};

/// What is reflected of white light in the plane x = 0, both angles in degrees from the normal, y.
Parts reflected(std::initializer_list<candela::Setting> settings, float observer, float light) {
    const auto model =
        candela::sdk::make<candela::ReflectionModel>(CANDELA_PLUGIN_DIR, "lommel-seeliger", settings);
    const float degree = 0.0174532925f, zero = 0, one = 1;
    const float vy = std::cos(observer * degree), vz = std::sin(observer * degree);
    const float ly = std::cos(light * degree), lz = std::sin(light * degree);
    float out[9] = {};
    model->reflect(
        {.count = 1,
         .normal = {&zero, &one, &zero},
         .to_observer = {&zero, &vy, &vz},
         .tangent = {},
         .color = {1, 1, 1},
         .position = {&zero, &zero, &zero}},
        {.to_light = {&zero, &ly, &lz}, .diffuse = {&one, &one, &one}, .specular = {&one, &one, &one}},
        {.ambient = {out, out + 1, out + 2},
         .diffuse = {out + 3, out + 4, out + 5},
         .specular = {out + 6, out + 7, out + 8}});
    return {out[3], out[6]};
}

}  // namespace

TEST_CASE("the full moon is flat: lit from where it is seen, an eighth of the albedo everywhere") {
    for (const float angle : {0.0f, 30.0f, 60.0f, 85.0f})
        CHECK_THAT(reflected({{"albedo", 0.8}}, angle, angle).diffuse, WithinRel(0.1, 1e-5));
}

TEST_CASE("seen straight on and lit from 60 degrees: w / 4 of a third") {
    CHECK_THAT(reflected({{"albedo", 0.6}}, 0, 60).diffuse, WithinRel(0.05, 1e-5));
}
