#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

TEST_CASE("light/ambient is colour times intensity everywhere, and comes from nowhere") {
    const auto light = instance<Light>("ambient", {{"color", Vec3{255, 51, 0}}, {"intensity", 0.5}});
    CHECK(light->sample_count() == 0);
    CHECK(test_registry().descriptor(candela::PluginKind::light, "ambient").has_ambient);
    Random random(3);
    each_way([&](std::size_t size) {
        std::vector<Vec3> positions;
        for (std::size_t i = 0; i < size; ++i) positions.push_back(random.point(5));
        for (const Vec3 intensity : illuminate_ambient(*light, positions)) {
            REQUIRE(agree(intensity, Double3{0.5, 0.1, 0}, 1e-6));
        }
    });
}

TEST_CASE("a light's colour is decoded from sRGB where colours are managed (IEC 61966-2-1)") {
    const auto light =
        instance<Light>("ambient", {{"color", Vec3{188, 128, 10}}}, candela::ColorEncoding::srgb);
    // 188/255 decodes to 0.5029, 128/255 to 0.2159, 10/255 to 0.003035.
    CHECK(agree(illuminate_ambient(*light, {Vec3{}})[0], Double3{0.5029, 0.2159, 0.003035}, 1e-3));
}
