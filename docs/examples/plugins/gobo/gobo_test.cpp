#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cstdint>

using Catch::Matchers::WithinAbs;

namespace {

/// The intensity at a point of the floor from a projector of 90 degrees with 2 x 2 panes, 2 m above it and
/// pointing down.
float sent_to(float x, float z) {
    const auto light = candela::sdk::make<candela::Light>(CANDELA_PLUGIN_DIR, "gobo",
                                                          {{"position", candela::Vec3{0, 2, 0}},
                                                           {"direction", candela::Vec3{0, -1, 0}},
                                                           {"angle", 90.0},
                                                           {"panes", std::int64_t{2}},
                                                           {"intensity", 4.0}});
    const float zero = 0, one = 1;
    float out[9] = {};
    light->illuminate(0, {.count = 1, .position = {&x, &zero, &z}, .normal = {&zero, &one, &zero}},
                      {.to_light = {out, out + 1, out + 2},
                       .diffuse = {out + 3, out + 4, out + 5},
                       .specular = {out + 6, out + 7, out + 8}});
    CHECK(out[3] == out[6]);
    return out[3];
}

}  // namespace

TEST_CASE("in the middle of a pane, 1 m to the side and 1 m ahead, all light for that distance arrives") {
    CHECK_THAT(sent_to(1, 1), WithinAbs(4.0 / 6, 1e-5));
    CHECK_THAT(sent_to(-1, 1), WithinAbs(4.0 / 6, 1e-5));
}

TEST_CASE("a fiftieth of the light passes the bars, and none falls outside the field") {
    CHECK_THAT(sent_to(0, 1), WithinAbs(0.02 * 4 / 5, 1e-5));
    CHECK_THAT(sent_to(0.1f, 1), WithinAbs(0.02 * 4 / 5.01, 1e-5));
    CHECK_THAT(sent_to(1.9f, 1), WithinAbs(0.02 * 4 / 8.61, 1e-5));
    CHECK(sent_to(2.1f, 1) == 0);
    CHECK(sent_to(1, -2.1f) == 0);
}
