#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;
using candela::Vec3Arrays;

namespace {

std::vector<Vec3> received(const Light& light, const std::vector<Vec3>& normals) {
    Vec3Arrays position, normal, ambient;
    for (Vec3Arrays* arrays : {&position, &normal, &ambient}) arrays->resize(normals.size());
    for (std::size_t i = 0; i < normals.size(); ++i) normal.span().set(i, normals[i]);
    light.illuminate_ambient({normals.size(), position.span(), normal.span()}, ambient.span());
    std::vector<Vec3> result;
    for (std::size_t i = 0; i < normals.size(); ++i) result.push_back(ambient.span()[i]);
    return result;
}

/// The share of a matt surface's light that comes from above the horizon if the whole world is equally
/// bright: the integral of max(N.w, 0) / pi over the directions w with w.up > 0, by the midpoint rule.
double seen_of_the_sky(double angle_to_up) {
    constexpr int k_steps = 600;
    const Double3 normal{std::sin(angle_to_up), std::cos(angle_to_up), 0};
    double sum = 0;
    for (int i = 0; i < k_steps; ++i) {
        const double y = (i + 0.5) / k_steps,
                     radius = std::sqrt(1 - y * y);  // equal areas for equal steps of y
        for (int j = 0; j < k_steps; ++j) {
            const double around = 2 * std::numbers::pi * (j + 0.5) / k_steps;
            const Double3 w{radius * std::cos(around), y, radius * std::sin(around)};
            sum += std::max(dot(normal, w), 0.0);
        }
    }
    return 2 * sum / (static_cast<double>(k_steps) * k_steps);
}

}  // namespace

TEST_CASE("light/hemisphere blends ground and sky by 1/2 + N.up / 2, and comes from nowhere") {
    const auto light = instance<Light>("hemisphere", {{"sky_color", Vec3{51, 102, 255}},
                                                      {"ground_color", Vec3{102, 51, 0}},
                                                      {"intensity", 2.5},
                                                      {"up", Vec3{0, 3, 4}}});
    CHECK(light->sample_count() == 0);
    CHECK(test_registry().descriptor(candela::PluginKind::light, "hemisphere").has_ambient);
    const Double3 sky{0.5, 1, 2.5}, ground{1, 0.5, 0};
    each_way([&](std::size_t size) {
        Random random(static_cast<unsigned>(size));
        std::vector<Vec3> normals;
        for (std::size_t i = 0; i < size; ++i) normals.push_back(random.direction());
        const std::vector<Vec3> intensity = received(*light, normals);
        for (std::size_t i = 0; i < size; ++i) {
            const double share = 0.5 + 0.5 * dot(exact(normals[i]), Double3{0, 0.6, 0.8});
            REQUIRE(agree(intensity[i], share * sky + (1 - share) * ground, 1e-5, 1e-6));
        }
    });
}

TEST_CASE("light/hemisphere is what a matt surface receives from an evenly bright sky") {
    const auto light = instance<Light>("hemisphere");  // white above, black below, up is y
    for (const double degrees : {0.0, 25.0, 60.0, 90.0, 130.0, 180.0}) {
        INFO(degrees << " degrees from the zenith");
        const double a = degrees * std::numbers::pi / 180;
        const Vec3 normal{static_cast<float>(std::sin(a)), static_cast<float>(std::cos(a)), 0};
        CHECK(agree(received(*light, {normal})[0].x, seen_of_the_sky(a), 1e-4, 1e-4));
    }
}

TEST_CASE("light/hemisphere with one colour is ambient light") {
    const auto hemisphere = instance<Light>(
        "hemisphere",
        {{"sky_color", Vec3{40, 80, 120}}, {"ground_color", Vec3{40, 80, 120}}, {"intensity", 3.0}});
    const auto ambient = instance<Light>("ambient", {{"color", Vec3{40, 80, 120}}, {"intensity", 3.0}});
    Random random(9);
    for (int i = 0; i < 20; ++i) {
        const Vec3 n = random.direction();
        CHECK(agree(received(*hemisphere, {n})[0], received(*ambient, {n})[0], 1e-6));
    }
}

TEST_CASE("light/hemisphere is never negative, even where rounding makes a normal slightly longer than one") {
    const auto light = instance<Light>("hemisphere", {{"intensity", 1e30}});
    CHECK(received(*light, {Vec3{0, -1.0001f, 0}})[0] == Vec3{});
    CHECK(received(*light, {Vec3{0, 1.0001f, 0}})[0] == Vec3{1e30f, 1e30f, 1e30f});
}
