#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "candela/kernel/kernel.h"
#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

TEST_CASE("reflection/cook-torrance is k_s F D G / (4 N.V) with Beckmann's D, over Lambert's diffuse light") {
    for (const double m : {0.1, 0.3, 1.0}) {
        for (const double ior : {1.33, 1.5, 10.0}) {
            INFO("m " << m << ", ior " << ior);
            const auto model = instance<ReflectionModel>(
                "cook-torrance", {{"kd", 0.6}, {"ks", 0.4}, {"roughness", m}, {"ior", ior}});
            check_reflection(
                *model,
                [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                    if (dot(n, l) <= 0) return {};
                    const Double3 h = unit(l + v);
                    const double tangent = std::tan(std::acos(std::min(dot(n, h), 1.0)));
                    const double d = std::exp(-std::pow(tangent / m, 2)) / (m * m * std::pow(dot(n, h), 4));
                    const double observer = std::max(dot(n, v), 1e-4);
                    const double g = std::min(
                        {1.0, 2 * dot(n, h) * observer / dot(v, h), 2 * dot(n, h) * dot(n, l) / dot(v, h)});
                    const double s = 0.4 * exact_fresnel(dot(v, h), ior) * d * g / (4 * observer);
                    return {0.6 * dot(n, l) * color, {s, s, s}};
                },
                2e-3);
        }
    }
}

TEST_CASE(
    "Beckmann's distribution integrates to 1 over all facets, seen from above (Walter et al. 2007, eq. 4)") {
    for (const float m : {0.1f, 0.3f, 0.6f, 1.0f}) {
        const double sum = over_hemisphere([&](Double3 h) {
            return static_cast<double>(candela::kernel::beckmann_distribution(static_cast<float>(h.y), m)) /
                   std::numbers::pi * h.y;
        });
        INFO("m " << m);
        CHECK(agree(sum, 1, 2e-3));
    }
}

TEST_CASE("Beckmann's distribution has hand-computed values for m = 0.3 at 0, 10, 20 and 30 degrees") {
    // exp(-tan^2 / 0.09) / (0.09 cos^4)
    const auto d = [](double degrees) {
        return static_cast<double>(candela::kernel::beckmann_distribution(
            static_cast<float>(std::cos(degrees * std::numbers::pi / 180)), 0.3f));
    };
    CHECK(agree(d(0), 11.1111, 1e-4));
    CHECK(agree(d(10), 8.3635, 1e-3));
    CHECK(agree(d(20), 3.2695, 1e-3));
    CHECK(agree(d(30), 0.48651, 1e-3));
}

TEST_CASE(
    "fresnel_dielectric is 0.04 straight on glass, half of s-polarised light's at Brewster's angle, and 1 "
    "beyond the critical angle") {
    const auto f = [](double cosine, double ior) {
        return static_cast<double>(
            candela::kernel::fresnel_dielectric(static_cast<float>(cosine), static_cast<float>(ior)));
    };
    CHECK(agree(f(1, 1.5), 0.04, 1e-5));
    CHECK(agree(f(1, 1 / 1.5), 0.04, 1e-5));
    const double brewster = std::atan(1.5);  // 56.31 degrees
    CHECK(agree(f(std::cos(brewster), 1.5), 0.5 * std::pow((1.5 * 1.5 - 1) / (1.5 * 1.5 + 1), 2), 1e-4));
    const double critical = std::asin(1 / 1.5);  // 41.81 degrees
    CHECK(f(std::cos(critical + 0.001), 1 / 1.5) == 1);
    CHECK(f(std::cos(critical - 0.001), 1 / 1.5) < 0.9);
    CHECK(f(0, 1.5) == 1);
    for (double degrees = 0; degrees < 90; degrees += 3) {
        const double cosine = std::cos(degrees * std::numbers::pi / 180);
        CHECK(agree(f(cosine, 1.7), exact_fresnel(cosine, 1.7), 2e-4));
    }
}
