#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

namespace {

/// The light that a matt white surface reflects: the sum of max(N.L, 0) I.
Double3 reflected(const Light& light, Double3 normal) {
    const auto* const data = candela::extension_of<candela::PunctualSource>(light);
    REQUIRE(data != nullptr);
    Double3 sum;
    for (int i = 0; i < light.sample_count(); ++i) {
        const candela::PunctualLight s = data->as_punctual(i);
        REQUIRE(s.w == 0);
        sum = sum +
              std::max(dot(normal, exact(s.position)), 0.0) * Double3{s.diffuse.r, s.diffuse.g, s.diffuse.b};
    }
    return sum;
}

}  // namespace

TEST_CASE("light/gradient lights a matt surface as the integral of its colours does, in any direction") {
    // The gradient is the horizon b everywhere, plus (a - b) h above and (c - b) |h| below. The integral of
    // h max(N.w, 0) over the upper hemisphere is 2 pi / 3 for N = up and 2 / 3 for N on the horizon.
    const double a = 0.9, b = 0.4, c = 0.1;
    for (const auto& [samples, most] : {std::pair{64, 0.03}, {256, 0.01}, {1024, 0.004}}) {
        const Double3 up = unit({0.3, 0.8, -0.4});
        const auto light = instance<Light>("gradient", {{"zenith_color", Vec3{229.5f, 229.5f, 229.5f}},
                                                        {"horizon_color", Vec3{102, 102, 102}},
                                                        {"ground_color", Vec3{25.5f, 25.5f, 25.5f}},
                                                        {"intensity", 2.0},
                                                        {"up", Vec3{0.3f, 0.8f, -0.4f}},
                                                        {"samples", std::int64_t{samples}}});
        REQUIRE(light->sample_count() == samples);
        INFO(samples << " samples");
        const Double3 aside = unit(cross(up, {1, 0, 0}));
        CHECK(std::abs(reflected(*light, up).x / (2 * (b + 2.0 / 3 * (a - b))) - 1) < most);
        CHECK(std::abs(reflected(*light, -1 * up).x / (2 * (b + 2.0 / 3 * (c - b))) - 1) < most);
        const double sideways = b + 2.0 / (3 * M_PI) * (a - b + c - b);
        CHECK(std::abs(reflected(*light, aside).x / (2 * sideways) - 1) < most);
    }
}

TEST_CASE("light/gradient of one colour is a sky of that colour") {
    const auto light = instance<Light>("gradient", {{"zenith_color", Vec3{255, 127.5f, 51}},
                                                    {"horizon_color", Vec3{255, 127.5f, 51}},
                                                    {"ground_color", Vec3{255, 127.5f, 51}},
                                                    {"samples", std::int64_t{256}}});
    Random random(8);
    for (int i = 0; i < 200; ++i) {
        const Double3 normal = exact(random.direction());
        CHECK(length(reflected(*light, normal) - Double3{1, 0.5, 0.2}) < 0.015);
    }
}

TEST_CASE("light/gradient is seen as what its samples send") {
    const auto light = instance<Light>("gradient", {{"ground_color", Vec3{0, 0, 255}},
                                                    {"horizon_color", Vec3{0, 255, 0}},
                                                    {"zenith_color", Vec3{255, 0, 0}},
                                                    {"intensity", 3.0}});
    const auto* const sky = candela::extension_of<candela::SkySource>(*light);
    REQUIRE(sky != nullptr);
    const candela::EnvironmentMap seen = candela::environment_of(*sky);
    const auto is = [&](Vec3 towards, Double3 expected) {
        const candela::Rgb at = seen.seen(towards);
        return length(Double3{at.r, at.g, at.b} - expected) < 0.02;
    };
    CHECK(is({0, 1, 0}, {3, 0, 0}));
    CHECK(is({1, 0, 0}, {0, 3, 0}));
    CHECK(is({0, -1, 0}, {0, 0, 3}));
    CHECK(is({0, 0.6f, -0.8f}, {1.8, 1.2, 0}));
}
