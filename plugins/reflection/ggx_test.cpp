#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "candela/kernel/kernel.h"
#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

namespace {

/// Smith's Lambda for GGX (Heitz 2014, eq. 72).
double lambda(double cosine, double alpha) {
    const double tangent = std::tan(std::acos(std::min(cosine, 1.0)));
    return (-1 + std::sqrt(1 + std::pow(alpha * tangent, 2))) / 2;
}

}  // namespace

TEST_CASE(
    "reflection/ggx is k_s F D G / (4 N.V) with height-correlated masking and shadowing, 1 / (1 + Lambda_V + "
    "Lambda_L)") {
    for (const double alpha : {0.1, 0.4, 1.0}) {
        for (const std::string fresnel : {"exact", "schlick"}) {
            INFO("alpha " << alpha << ", " << fresnel);
            const auto model = instance<ReflectionModel>(
                "ggx", {{"kd", 0.6}, {"ks", 0.4}, {"roughness", alpha}, {"ior", 1.8}, {"fresnel", fresnel}});
            check_reflection(
                *model,
                [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                    if (dot(n, l) <= 0) return {};
                    const Double3 h = unit(l + v);
                    const double observer = std::max(dot(n, v), 1e-4);
                    const double theta = std::acos(std::min(dot(n, h), 1.0));
                    // Walter et al. (2007), eq. 33, times pi.
                    const double d = alpha * alpha /
                                     (std::pow(std::cos(theta), 4) *
                                      std::pow(alpha * alpha + std::pow(std::tan(theta), 2), 2));
                    const double g = 1 / (1 + lambda(observer, alpha) + lambda(dot(n, l), alpha));
                    const double f0 = std::pow(0.8 / 2.8, 2);
                    const double f = fresnel == "exact" ? exact_fresnel(dot(v, h), 1.8)
                                                        : f0 + (1 - f0) * std::pow(1 - dot(v, h), 5);
                    const double s = 0.4 * f * d * g / (4 * observer);
                    return {0.6 * dot(n, l) * color, {s, s, s}};
                },
                1e-3);
        }
    }
}

TEST_CASE(
    "GGX's distribution integrates to 1 over all facets seen from above, and over the visible facets from "
    "any side") {
    for (const float alpha : {0.1f, 0.4f, 1.0f}) {
        const auto d = [&](Double3 h) {
            return static_cast<double>(candela::kernel::ggx_distribution(static_cast<float>(h.y), alpha)) /
                   std::numbers::pi;
        };
        INFO("alpha " << alpha);
        CHECK(agree(over_hemisphere([&](Double3 h) { return d(h) * h.y; }), 1, 5e-3));
        // Heitz 2014, eq. 14: with Smith's masking the visible facets' projected area is the surface's own.
        for (const double degrees : {20.0, 50.0, 75.0}) {
            const double angle = degrees * std::numbers::pi / 180;
            const Double3 v{std::sin(angle), std::cos(angle), 0};
            const double mask = 1 / (1 + lambda(v.y, static_cast<double>(alpha)));
            const double visible =
                over_hemisphere([&](Double3 h) { return mask * std::max(dot(v, h), 0.0) * d(h); });
            CHECK(agree(visible, v.y, 5e-3));
        }
    }
}

TEST_CASE("GGX's distribution has hand-computed values for alpha = 0.3 at 0, 10, 20 and 30 degrees") {
    // 0.09 / (1 - 0.91 cos^2)^2
    const auto d = [](double degrees) {
        return static_cast<double>(candela::kernel::ggx_distribution(
            static_cast<float>(std::cos(degrees * std::numbers::pi / 180)), 0.3f));
    };
    CHECK(agree(d(0), 11.1111, 1e-4));
    CHECK(agree(d(10), 6.52468, 1e-3));
    CHECK(agree(d(20), 2.33246, 1e-3));
    CHECK(agree(d(30), 0.89197, 1e-3));
}

TEST_CASE(
    "fresnel_schlick is exact straight on and at 90 degrees, and within 0.04 of Fresnel's equations for "
    "glass") {
    const auto f = [](double cosine) {
        return static_cast<double>(candela::kernel::fresnel_schlick(static_cast<float>(cosine), 1.5f));
    };
    CHECK(agree(f(1), 0.04, 1e-5));
    CHECK(f(0) == 1);
    for (double degrees = 0; degrees < 90; degrees += 5) {
        const double cosine = std::cos(degrees * std::numbers::pi / 180);
        CHECK(std::abs(f(cosine) - exact_fresnel(cosine, 1.5)) < 0.04);
    }
}
