#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

TEST_CASE("light/directional is constant in direction and intensity") {
    const auto light = instance<Light>(
        "directional", {{"direction", Vec3{0, -3, -4}}, {"color", Vec3{255, 102, 51}}, {"intensity", 2.0}});
    check_light(*light, [](Double3) -> ExactIncident { return {{0, 0.6, 0.8}, {2, 0.8, 0.4}}; }, 1e-6);
}
