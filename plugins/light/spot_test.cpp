#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

namespace {

constexpr double k_degree = 3.14159265358979323846 / 180;

void check_falloff(const char* name, const std::function<double(double)>& shape) {
    INFO(name);
    const auto light = instance<Light>("spot", {{"position", Vec3{0, 4, 0}},
                                                {"direction", Vec3{0, -2, 0}},
                                                {"intensity", 10.0},
                                                {"inner_angle", 20.0},
                                                {"outer_angle", 50.0},
                                                {"falloff", std::string(name)}});
    check_light(
        *light,
        [&](Double3 p) -> ExactIncident {
            const Double3 d = Double3{0, 4, 0} - p;
            const double cosine = unit(d).y;  // of the angle to the axis, which points down
            const double inner = std::cos(20 * k_degree), outer = std::cos(50 * k_degree);
            const double t = std::clamp((cosine - outer) / (inner - outer), 0.0, 1.0);
            const double i = 10 * shape(t) / dot(d, d);
            return {unit(d), {i, i, i}};
        },
        2e-5);
}

float intensity_at(const Light& light, double degrees) {
    const Vec3 below{static_cast<float>(4 * std::tan(degrees * k_degree)), 0, 0};
    return illuminate(light, {below})[0].diffuse.x;
}

}  // namespace

TEST_CASE("light/spot is a point light times smoothstep, or linear, between the cosines of its two cones") {
    check_falloff("smoothstep", [](double t) { return t * t * (3 - 2 * t); });
    check_falloff("linear", [](double t) { return t; });
}

TEST_CASE(
    "light/spot gives full light within the inner cone, none beyond the outer, and a hard edge where they "
    "coincide") {
    const auto soft = instance<Light>(
        "spot",
        {{"position", Vec3{0, 4, 0}}, {"direction", Vec3{0, -1, 0}}, {"attenuation", std::string("none")}});
    CHECK(agree(intensity_at(*soft, 14.9), 1, 1e-5));
    CHECK(intensity_at(*soft, 25.1) == 0);
    CHECK(intensity_at(*soft, 20) > 0.05f);
    CHECK(intensity_at(*soft, 20) < 0.95f);
    const auto hard = instance<Light>("spot", {{"position", Vec3{0, 4, 0}},
                                               {"direction", Vec3{0, -1, 0}},
                                               {"attenuation", std::string("none")},
                                               {"inner_angle", 25.0}});
    CHECK(agree(intensity_at(*hard, 24.9), 1, 1e-5));
    CHECK(intensity_at(*hard, 25.1) == 0);
}
