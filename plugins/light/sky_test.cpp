#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <vector>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::PunctualLight;
using candela::Vec3;

namespace {

constexpr double k_degrees = M_PI / 180;

std::vector<PunctualLight> samples_of(const Light& light) {
    const auto* const data = candela::extension_of<candela::PunctualSource>(light);
    REQUIRE(data != nullptr);
    std::vector<PunctualLight> samples;
    for (int i = 0; i < light.sample_count(); ++i) samples.push_back(data->as_punctual(i));
    return samples;
}

double luminance(candela::Rgb c) {
    return 0.2126 * static_cast<double>(c.r) + 0.7152 * static_cast<double>(c.g) +
           0.0722 * static_cast<double>(c.b);
}

candela::Rgb seen(const Light& light, Double3 towards) {
    const auto* const sky = candela::extension_of<candela::SkySource>(light);
    REQUIRE(sky != nullptr);
    const Vec3 d{static_cast<float>(towards.x), static_cast<float>(towards.y), static_cast<float>(towards.z)};
    candela::Rgb at;
    sky->see(1, {&d.x, &d.y, &d.z}, {&at.r, &at.g, &at.b});
    return at;
}

Double3 at_elevation(double degrees, double azimuth = 0) {
    const double e = degrees * k_degrees, a = azimuth * k_degrees;
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

Vec3 vector(Double3 v) { return {static_cast<float>(v.x), static_cast<float>(v.y), static_cast<float>(v.z)}; }

/// Preetham et al. (1999), appendix A: luminance in kcd/m^2.
double preetham_luminance(double turbidity, double theta_sun, double theta, double gamma) {
    const double t = turbidity, chi = (4.0 / 9 - t / 120) * (M_PI - 2 * theta_sun);
    const double zenith = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const std::array k{0.1787 * t - 1.4630, -0.3554 * t + 0.4275, -0.0227 * t + 5.3251, 0.1206 * t - 2.5771,
                       -0.0670 * t + 0.3703};
    const auto f = [&](double cosine, double angle) {
        return (1 + k[0] * std::exp(k[1] / cosine)) *
               (1 + k[2] * std::exp(k[3] * angle) + k[4] * std::pow(std::cos(angle), 2));
    };
    return zenith * f(std::cos(theta), gamma) / f(1, theta_sun);
}

/// The direction of the sun.
Double3 sun_of(candela::ParamSet values) {
    const auto light = test_registry().create<Light>("sky", values, candela::ColorEncoding::none);
    return exact(samples_of(*light)[0].position);
}

candela::ParamSet at_time(double day, double hour, double latitude, double longitude = 0, double zone = 0) {
    candela::ParamSet values = test_registry().parameters(candela::PluginKind::light, "sky");
    values.set("sun", std::string("time"));
    values.set("day", day);
    values.set("hour", hour);
    values.set("latitude", latitude);
    values.set("longitude", longitude);
    values.set("time_zone", zone);
    return values;
}

}  // namespace

TEST_CASE("light/sky has the luminance of Preetham's fit in every direction, 1 for 40,000 cd/m2") {
    Random random(4);
    for (const double turbidity : {2.0, 3.5, 6.0, 10.0}) {
        for (const double elevation : {5.0, 30.0, 65.0}) {
            const Double3 sun = at_elevation(elevation, 130);
            const auto light = instance<Light>("sky", {{"to_sun", vector(sun)}, {"turbidity", turbidity}});
            for (int i = 0; i < 100; ++i) {
                const Double3 d = at_elevation(random.number(2, 89), random.number(0, 360));
                const double gamma = std::acos(std::clamp(dot(d, sun), -1.0, 1.0));
                if (gamma < k_degrees) continue;
                const double expected =
                    preetham_luminance(turbidity, (90 - elevation) * k_degrees, std::acos(d.y), gamma);
                const candela::Rgb rgb = seen(*light, d);
                // Colours outside sRGB are clipped.
                if (std::min({rgb.r, rgb.g, rgb.b}) <= 0) continue;
                INFO("turbidity " << turbidity << ", sun at " << elevation);
                REQUIRE(std::abs(luminance(rgb) * 40 / expected - 1) < 1e-3);
            }
        }
    }
}

TEST_CASE("light/sky is blue overhead at noon, and its sun is redder the lower it stands") {
    double before = 0;
    for (const double elevation : {70.0, 30.0, 10.0, 3.0}) {
        const auto light = instance<Light>("sky", {{"to_sun", vector(at_elevation(elevation))}});
        const candela::Rgb sun = samples_of(*light)[0].diffuse;
        CHECK(sun.r > sun.g);
        CHECK(sun.g > sun.b);
        CHECK(static_cast<double>(sun.r / sun.b) > before);
        before = static_cast<double>(sun.r / sun.b);
    }
    const auto noon = instance<Light>("sky", {{"to_sun", vector(at_elevation(50))}, {"turbidity", 2.5}});
    const candela::Rgb zenith = seen(*noon, {0, 1, 0});
    CHECK(zenith.b > 1.5f * zenith.r);
}

TEST_CASE("light/sky sends what is seen of it: samples add up to the integral over the sky") {
    const auto light = instance<Light>(
        "sky",
        {{"to_sun", vector(at_elevation(40, 70))}, {"intensity", 2.0}, {"samples", std::int64_t{1024}}});
    const std::vector<PunctualLight> samples = samples_of(*light);
    REQUIRE(samples.size() == 1 + 1024 + 256);
    constexpr int k_columns = 360, k_rows = 90;
    Random random(21);
    for (int n = 0; n < 12; ++n) {
        const Double3 normal = exact(random.direction());
        double expected = 0, ground = 0, actual = 0, from_ground = 0;
        for (int row = 0; row < k_rows; ++row) {
            const double angle =
                2 * M_PI / k_columns * (std::sin((row + 1.0) * k_degrees) - std::sin(row * 1.0 * k_degrees));
            for (int column = 0; column < k_columns; ++column) {
                const Double3 d = at_elevation(row + 0.5, column + 0.5);
                const double weight = angle * std::max(dot(d, normal), 0.0) / M_PI;
                if (dot(d, exact(samples[0].position)) < 0.9998)  // not the sun's disc
                    expected += weight * luminance(seen(*light, d));
                const Double3 down{d.x, -d.y, d.z};
                ground += angle * std::max(dot(down, normal), 0.0) / M_PI * luminance(seen(*light, down));
            }
        }
        for (std::size_t i = 1; i < samples.size(); ++i) {
            const double sent =
                std::max(dot(exact(samples[i].position), normal), 0.0) * luminance(samples[i].diffuse);
            (i <= 1024 ? actual : from_ground) += sent;
        }
        INFO("normal " << normal.x << ' ' << normal.y << ' ' << normal.z);
        CHECK(std::abs(actual - expected) < 0.015 * expected + 0.002);
        CHECK(std::abs(from_ground - ground) < 0.02 * ground + 0.002);
    }
}

TEST_CASE("light/sky's ground reflects the light of sun and sky") {
    const auto light = instance<Light>("sky", {{"to_sun", vector(at_elevation(40))},
                                               {"ground_color", Vec3{127.5f, 127.5f, 127.5f}},
                                               {"samples", std::int64_t{1024}}});
    double received = 0;
    for (const PunctualLight& s : samples_of(*light))
        received += static_cast<double>(std::max(s.position.y, 0.0f)) * luminance(s.diffuse);
    CHECK(std::abs(luminance(seen(*light, {0, -1, 0})) / (0.5 * received) - 1) < 0.03);
}

TEST_CASE("light/sky finds the sun by date, time and place") {
    // Declination 23.4 degrees at the June solstice: 90 - 50 + 23.4 at solar noon, in the south.
    double highest = 0, when = 0;
    Double3 noon;
    for (double hour = 10; hour < 14; hour += 0.02) {
        const Double3 sun = sun_of(at_time(172, hour, 50));
        if (sun.y > highest) highest = sun.y, when = hour, noon = sun;
    }
    CHECK(std::abs(std::asin(highest) / k_degrees - 63.4) < 0.2);
    CHECK(std::abs(when - 12.03) < 0.05);  // the equation of time: the sun is two minutes late
    CHECK(noon.z > 0.4);
    CHECK(std::abs(noon.x) < 0.02);
    // In the morning it is in the east, in the evening in the west; in the south, at noon in the north.
    CHECK(sun_of(at_time(81, 8, 50)).x > 0.7);
    CHECK(sun_of(at_time(81, 16, 50)).x < -0.7);
    CHECK(sun_of(at_time(172, 12, -34)).z < -0.7);
    // Fifteen degrees further east, with clocks an hour ahead, it is there at the same time by the clock.
    CHECK(length(sun_of(at_time(100, 15, 40)) - sun_of(at_time(100, 15, 40, 15, 1))) < 1e-4);
    // Early in November the sun is 16 minutes early.
    const Double3 early = sun_of(at_time(307, 12 - 0.273, 50));
    CHECK(std::abs(early.x) < 0.02);
    candela::ParamSet turned = at_time(172, 12, 50);
    const Double3 before = sun_of(turned);
    turned.set("north", 90.0);
    CHECK(length(sun_of(turned) - Double3{before.z, before.y, -before.x}) < 1e-5);
}

TEST_CASE("light/sky is dark while the sun is below the horizon") {
    const auto light = instance<Light>("sky", {{"to_sun", Vec3{0, -0.2f, 1}}});
    for (const PunctualLight& s : samples_of(*light)) CHECK(luminance(s.diffuse) == 0);
    CHECK(luminance(seen(*light, {0, 1, 0})) == 0);
}
