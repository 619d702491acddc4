#include <candela/plugin_test.h>

#include <catch2/catch_test_macros.hpp>
#include <catch2/matchers/catch_matchers_floating_point.hpp>
#include <cmath>
#include <cstdint>
#include <initializer_list>

using Catch::Matchers::WithinAbs;

namespace {

struct Sun {
    double elevation, azimuth;  // degrees; clockwise from north
    float intensity;
};

Sun sun_at(std::initializer_list<candela::ParamSetting> settings) {
    const auto light = candela::sdk::make<candela::Light>(CANDELA_PLUGIN_DIR, "sun", settings);
    const float zero = 0, one = 1;
    float out[9] = {};
    light->illuminate(0, {.count = 1, .position = {&zero, &zero, &zero}, .normal = {&zero, &one, &zero}},
                      {.to_light = {out, out + 1, out + 2},
                       .diffuse = {out + 3, out + 4, out + 5},
                       .specular = {out + 6, out + 7, out + 8}});
    const double degree = 180 / 3.14159265358979;
    const double azimuth = degree * std::atan2(double{out[0]}, -double{out[2]});
    return {degree * std::asin(double{out[1]}), azimuth < 0 ? azimuth + 360 : azimuth, out[3]};
}

}  // namespace

TEST_CASE(
    "17 October 2003, 12:30:30 in Golden, Colorado: the example of Reda and Andreas (2004), table A5.1") {
    const Sun sun = sun_at({{"year", std::int64_t{2003}},
                            {"month", std::int64_t{10}},
                            {"day", std::int64_t{17}},
                            {"hour", 19 + 30.5 / 60},
                            {"latitude", 39.742476},
                            {"longitude", -105.1786}});
    CHECK_THAT(sun.elevation, WithinAbs(39.872046, 0.02));  // without refraction
    CHECK_THAT(sun.azimuth, WithinAbs(194.340241, 0.02));
}

TEST_CASE("at noon of an equinox the sun is overhead at the equator, and at midnight there is none") {
    const auto equator = [](double hour) {
        // The equinox of 2024 was at 3:06 UTC; the equation of time was 7.5 minutes.
        return sun_at({{"year", std::int64_t{2024}},
                       {"month", std::int64_t{3}},
                       {"day", std::int64_t{20}},
                       {"hour", hour},
                       {"latitude", 0.0},
                       {"longitude", 0.0}});
    };
    CHECK_THAT(equator(12 + 7.5 / 60).elevation, WithinAbs(90, 0.2));
    CHECK(equator(12).intensity == 1);
    CHECK(equator(0).intensity == 0);
}
