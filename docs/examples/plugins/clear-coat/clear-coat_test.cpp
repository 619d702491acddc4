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
        candela::sdk::make<candela::ReflectionModel>(CANDELA_PLUGIN_DIR, "clear-coat", settings);
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

TEST_CASE("seen and lit straight on, glass of 1.5 mirrors 4 % and lets 96 % through, twice") {
    const Parts parts = reflected({{"kd", 0.5}, {"ior", 1.5}, {"roughness", 0.5}}, 0, 0);
    CHECK_THAT(parts.diffuse, WithinRel(0.5 * 0.96 * 0.96, 1e-5));
    // F D G / 4, with D = 1 / alpha^2 and G = 1.
    CHECK_THAT(parts.specular, WithinRel(0.04 / 0.25 / 4, 1e-5));
}

TEST_CASE("at 60 degrees on both sides the ground gets what Schlick's formula lets through") {
    const double through = 1 - (0.04 + 0.96 * std::pow(0.5, 5));
    CHECK_THAT(reflected({{"kd", 1.0}, {"ior", 1.5}}, 60, -60).diffuse,
               WithinRel(0.5 * through * through, 1e-5));
}
