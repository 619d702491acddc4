#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;

/// Beckmann's density of facets (Walter et al. 2007, eq. 25).
double density(double cosine, double alpha) {
    const double tangent = std::tan(std::acos(std::min(cosine, 1.0)));
    return std::exp(-std::pow(tangent / alpha, 2)) / (k_pi * alpha * alpha * std::pow(cosine, 4));
}

/// Smith's Lambda for Beckmann's distribution, exact (Heitz 2014, eq. 66).
double lambda(double cosine, double alpha) {
    const double a = 1 / (alpha * std::tan(std::acos(std::min(cosine, 1.0))));
    return (std::erf(a) - 1) / 2 + std::exp(-a * a) / (2 * a * std::sqrt(k_pi));
}

std::unique_ptr<ReflectionModel> beckmann(double alpha, const std::string& masking) {
    return instance<ReflectionModel>("beckmann",
                                     {{"kd", 0.0}, {"ks", 1.0}, {"roughness", alpha}, {"masking", masking}});
}

Double3 at(double degrees) { return {std::sin(degrees * k_pi / 180), std::cos(degrees * k_pi / 180), 0}; }

/// The highlight on a surface facing +y.
double highlight(const ReflectionModel& model, Double3 v, Double3 l) {
    const auto rounded = [](Double3 d) {
        return Vec3{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    };
    const ReflectionSample sample{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}};
    return static_cast<double>(reflect(model, {sample}, {1, 1, 1})[0].specular.x);
}

/// The visible share of facets, G_1, that explains the highlight of light from straight above, which reaches
/// all of them.
double visible(const ReflectionModel& model, double degrees, double alpha) {
    const Double3 n{0, 1, 0}, v = at(degrees), h = unit(n + v);
    return highlight(model, v, n) * 4 * v.y / (k_pi * density(h.y, alpha) * exact_fresnel(dot(v, h), 1.5));
}

}  // namespace

TEST_CASE(
    "reflection/beckmann is k_s F D G / (4 N.V) with Smith's exact masking to 0.7 %, correlated or "
    "separable") {
    for (const double alpha : {0.1, 0.4, 1.0}) {
        for (const std::string masking : {"correlated", "separable"}) {
            for (const std::string fresnel : {"exact", "schlick"}) {
                INFO("alpha " << alpha << ", " << masking << ", " << fresnel);
                const auto model = instance<ReflectionModel>("beckmann", {{"kd", 0.6},
                                                                          {"ks", 0.4},
                                                                          {"roughness", alpha},
                                                                          {"ior", 1.8},
                                                                          {"fresnel", fresnel},
                                                                          {"masking", masking}});
                check_reflection(
                    *model,
                    [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                        if (dot(n, l) <= 0) return {};
                        const Double3 h = unit(l + v);
                        const double of_v = lambda(dot(n, v), alpha), of_l = lambda(dot(n, l), alpha);
                        const double g =
                            masking == "correlated" ? 1 / (1 + of_v + of_l) : 1 / ((1 + of_v) * (1 + of_l));
                        const double f0 = std::pow(0.8 / 2.8, 2);
                        const double f = fresnel == "exact" ? exact_fresnel(dot(v, h), 1.8)
                                                            : f0 + (1 - f0) * std::pow(1 - dot(v, h), 5);
                        const double s = 0.4 * f * k_pi * density(dot(n, h), alpha) * g / (4 * dot(n, v));
                        return {0.6 * dot(n, l) * color, {s, s, s}};
                    },
                    7e-3);
            }
        }
    }
}

TEST_CASE("reflection/beckmann has the values of Walter et al.'s rational approximation of the masking") {
    // a = 1 / (alpha tan(theta)) = 1.1547, 0.35265, 1 and 0.17633.
    const auto half = beckmann(0.5, "correlated"), one = beckmann(1, "separable");
    CHECK(agree(visible(*half, 60, 0.5), 0.98949, 2e-4));
    CHECK(agree(visible(*half, 80, 0.5), 0.71492, 2e-4));
    CHECK(agree(visible(*one, 45, 1), 0.97659, 2e-4));
    CHECK(agree(visible(*one, 80, 1), 0.46652, 2e-4));
    // From a = 1.6 on, everything is visible.
    CHECK(agree(visible(*half, 51, 0.5), 1, 2e-4));
}

TEST_CASE("Beckmann's visible facets have the surface's own projected area from any side: a weak furnace") {
    // Heitz 2014, eq. 14: the integral of G_1 max(V.H, 0) D is N.V.
    for (const double alpha : {0.3, 0.6, 1.0}) {
        const auto model = beckmann(alpha, "separable");
        for (const double degrees : {20.0, 50.0, 75.0, 85.0}) {
            const Double3 v = at(degrees);
            const double facets =
                over_hemisphere([&](Double3 h) { return std::max(dot(v, h), 0.0) * density(h.y, alpha); });
            INFO("alpha " << alpha << ", seen at " << degrees << " degrees");
            CHECK(agree(visible(*model, degrees, alpha) * facets, v.y, 5e-3));
        }
    }
}

TEST_CASE("reflection/beckmann: correlated masking is brighter than separable, and equal straight above") {
    const auto correlated = beckmann(0.8, "correlated"), separable = beckmann(0.8, "separable");
    CHECK(agree(highlight(*correlated, at(0), at(60)), highlight(*separable, at(0), at(60)), 1e-5));
    CHECK(highlight(*correlated, at(-85), at(85)) > 1.3 * highlight(*separable, at(-85), at(85)));
}

TEST_CASE("reflection/beckmann is Cook and Torrance's model where no facet hides another") {
    const auto smith = beckmann(0.1, "correlated");
    const auto grooves =
        instance<ReflectionModel>("cook-torrance", {{"kd", 0.0}, {"ks", 1.0}, {"roughness", 0.1}});
    for (const double light : {0.0, 15.0, 30.0})
        for (const double from_mirror : {0.0, 5.0, 10.0})
            CHECK(agree(highlight(*smith, at(from_mirror - light), at(light)),
                        highlight(*grooves, at(from_mirror - light), at(light)), 1e-5));
}

TEST_CASE("reflection/beckmann has GGX's peak, but not its glow") {
    const auto compact = beckmann(0.2, "correlated");
    const auto glowing = instance<ReflectionModel>("ggx", {{"kd", 0.0}, {"ks", 1.0}, {"roughness", 0.2}});
    CHECK(agree(highlight(*compact, at(0), at(0)), highlight(*glowing, at(0), at(0)), 1e-5));
    CHECK(agree(highlight(*compact, at(0), at(0)), 0.04 / (4 * 0.04), 1e-4));
    CHECK(highlight(*glowing, at(0), at(60)) > 20 * highlight(*compact, at(0), at(60)));
}
