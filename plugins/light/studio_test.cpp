#include <algorithm>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <functional>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

namespace {

constexpr double k_degrees = M_PI / 180;

double smooth_step(double low, double high, double x) {
    const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
    return t * t * (3 - 2 * t);
}

/// A box in the direction of an azimuth, from +z towards +x, and an elevation; half its width and height, as
/// seen from a distance of one.
struct Box {
    double azimuth, elevation, half_width, half_height, brightness;
};
constexpr Box k_boxes[] = {{0, 68, 0.5, 0.4, 3}, {-60, 15, 0.5, 0.75, 2.2}, {68, 12, 0.4, 0.75, 1.6}};

/// The studio as documented, in angles about each box's axis.
double described(Double3 d) {
    double sum = 0.25 + (d.y < 0 ? 0.15 * d.y * d.y : -0.15 * d.y);
    for (const Box& box : k_boxes) {
        // Turned so that the box is in front, on +z.
        const double a = -box.azimuth * k_degrees, e = box.elevation * k_degrees;
        const double x = std::cos(a) * d.x + std::sin(a) * d.z, z = std::cos(a) * d.z - std::sin(a) * d.x;
        const double up = std::cos(e) * d.y - std::sin(e) * z, ahead = std::cos(e) * z + std::sin(e) * d.y;
        if (ahead <= 0) continue;
        const auto edge = [&](double place, double half) {
            return 1 - smooth_step(0.6, 1, std::abs(place / ahead / half));
        };
        sum += box.brightness * edge(x, box.half_width) * edge(up, box.half_height);
    }
    return sum;
}

/// The light that a matt white surface reflects: the sum of max(N.L, 0) I.
double reflected(const Light& light, Double3 normal) {
    const auto* const data = candela::extension_of<candela::PunctualSource>(light);
    REQUIRE(data != nullptr);
    double sum = 0;
    for (int i = 0; i < light.sample_count(); ++i) {
        const candela::PunctualLight s = data->as_punctual(i);
        REQUIRE(s.w == 0);
        sum += std::max(dot(normal, exact(s.position)), 0.0) * static_cast<double>(s.diffuse.g);
    }
    return sum;
}

/// The integral of what is seen, by the midpoint rule in height and azimuth.
double integral(Double3 normal) {
    constexpr int k_rows = 400, k_columns = 800;
    double sum = 0;
    for (int row = 0; row < k_rows; ++row) {
        const double h = 2 * (row + 0.5) / k_rows - 1, radius = std::sqrt(1 - h * h);
        for (int column = 0; column < k_columns; ++column) {
            const double angle = 2 * M_PI * (column + 0.5) / k_columns;
            const Double3 d{radius * std::cos(angle), h, radius * std::sin(angle)};
            if (const double cosine = dot(d, normal); cosine > 0) sum += cosine * described(d);
        }
    }
    return sum * 4 / k_rows / k_columns;
}

}  // namespace

TEST_CASE("light/studio shows three boxes with soft edges between grey walls") {
    const auto light = instance<Light>("studio", {{"color", Vec3{255, 127.5f, 51}}, {"intensity", 2.0}});
    const auto* const sky = candela::extension_of<candela::SkySource>(*light);
    REQUIRE(sky != nullptr);
    Random random(12);
    double brightest = 0;
    for (int i = 0; i < 4000; ++i) {
        const Vec3 d = random.direction();
        candela::Rgb at;
        sky->see(1, {&d.x, &d.y, &d.z}, {&at.r, &at.g, &at.b});
        const double expected = 2 * described(exact(d));
        INFO(d.x << ' ' << d.y << ' ' << d.z);
        REQUIRE(length(Double3{at.r, at.g, at.b} - expected * Double3{1, 0.5, 0.2}) < 1e-4);
        brightest = std::max(brightest, expected);
    }
    CHECK(brightest > 6);
}

TEST_CASE("light/studio lights a matt surface as the integral of what is seen of it does, in any direction") {
    Random random(3);
    for (int n = 0; n < 12; ++n) {
        const Double3 normal = exact(random.direction());
        const double expected = integral(normal);
        INFO("normal " << normal.x << ' ' << normal.y << ' ' << normal.z);
        for (const auto& [samples, most] :
             {std::pair{32, 0.1}, {64, 0.05}, {128, 0.02}, {256, 0.007}, {1024, 0.002}}) {
            const auto light = instance<Light>("studio", {{"samples", std::int64_t{samples}}});
            REQUIRE(light->sample_count() == samples);
            INFO(samples << " samples");
            CHECK(std::abs(reflected(*light, normal) / expected - 1) < most);
        }
    }
}

TEST_CASE("under light/studio, a matt white surface is nearly white, and never beyond") {
    const auto light = instance<Light>("studio", {{"samples", std::int64_t{1024}}});
    Random random(5);
    double most = 0;
    for (int i = 0; i < 2000; ++i) most = std::max(most, reflected(*light, exact(random.direction())));
    CHECK(most < 0.98);
    CHECK(most > 0.95);
    const double facing = reflected(*light, {0, std::sin(20 * k_degrees), std::cos(20 * k_degrees)});
    CHECK(std::abs(facing - 0.87) < 0.01);
}

TEST_CASE("light/studio turns counter-clockwise, seen from above") {
    const auto front = instance<Light>("studio", {{"samples", std::int64_t{256}}});
    const auto turned = instance<Light>("studio", {{"samples", std::int64_t{256}}, {"rotation", 90.0}});
    Random random(9);
    for (int i = 0; i < 50; ++i) {
        const Double3 n = exact(random.direction());
        // The front, +z, comes to be on the right, +x.
        CHECK(std::abs(reflected(*turned, {n.z, n.y, -n.x}) - reflected(*front, n)) < 1e-4);
    }
}
