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

std::unique_ptr<ReflectionModel> eon(double roughness, double kd = 1) {
    return instance<ReflectionModel>("eon", {{"roughness", roughness}, {"kd", kd}});
}

double scale(double r) { return 1 / (1 + (0.5 - 2 / (3 * k_pi)) * r); }

/// Light that white facets reflect once, pi times Fujii's BRDF.
double once(Double3 n, Double3 v, Double3 l, double r) {
    const double s = dot(l, v) - dot(n, l) * dot(n, v);
    return scale(r) * (1 + r * s / (s > 0 ? std::max(dot(n, l), dot(n, v)) : 1));
}

/// The paper's closed forms for that light: its albedo in one direction, and the mean over all.
double once_albedo(double cosine, double r) {
    const double theta = std::acos(std::min(cosine, 1.0)), sine = std::sin(theta);
    const double g = sine * (theta - sine * std::cos(theta)) - 2 * sine / 3 +
                     2 * std::tan(theta) * (1 - std::pow(sine, 3)) / 3;
    return scale(r) * (1 + r * g / k_pi);
}
double once_mean(double r) { return scale(r) * (1 + (2.0 / 3 - 28 / (15 * k_pi)) * r); }

/// The colour of the light that leaves after several reflections, for facets of reflectance rho.
double often_color(double rho, double mean) { return rho * rho * mean / (1 - rho * (1 - mean)); }

Double3 at(double degrees, double phi_degrees = 0) {
    const double theta = degrees * k_pi / 180, phi = phi_degrees * k_pi / 180;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The reflected light of a white surface facing +y.
double seen(const ReflectionModel& model, Double3 v, Double3 l) {
    return static_cast<double>(
        reflect(model, {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1})[0].diffuse.x);
}

}  // namespace

TEST_CASE("reflection/eon is the paper's sum of light reflected once and more often, at each roughness") {
    for (const double r : {0.0, 0.2, 0.6, 1.0}) {
        INFO("roughness " << r);
        check_reflection(
            *eon(r, 0.9),
            [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                if (dot(n, l) <= 0) return {};
                const double missing = (1 - once_albedo(dot(n, l), r)) * (1 - once_albedo(dot(n, v), r));
                const auto channel = [&](double c) {
                    const double rho = 0.9 * c;
                    const double often =
                        r > 0 ? often_color(rho, once_mean(r)) * missing / (1 - once_mean(r)) : 0;
                    return dot(n, l) * (rho * once(n, v, l, r) + often);
                };
                return {{channel(color.x), channel(color.y), channel(color.z)}, {}};
            },
            1e-4);
    }
}

TEST_CASE("reflection/eon without roughness is Lambert's law") {
    check_reflection(
        *eon(0, 0.8),
        [&](Double3 n, Double3, Double3 l, Double3 color) -> ExactPair {
            return {std::max(dot(n, l), 0.0) * 0.8 * color, {}};
        },
        1e-5);
}

TEST_CASE("reflection/eon in white reflects all light in a white furnace, at every roughness and angle") {
    for (const double r : {0.1, 0.5, 1.0}) {
        for (const double degrees : {0.0, 30.0, 60.0, 80.0, 89.0}) {
            INFO("roughness " << r << ", seen at " << degrees << " degrees");
            CHECK(agree(directional_albedo(*eon(r), rounded(at(degrees))), 1, 5e-4));
        }
    }
}

TEST_CASE("reflection/eon adds just what integrals of light reflected once over all directions miss") {
    constexpr double k_rho = 0.8;
    constexpr Double3 k_n{0, 1, 0};
    for (const double r : {0.4, 1.0}) {
        const auto albedo = [&](Double3 v) {
            return over_hemisphere([&](Double3 l) { return once(k_n, v, l, r) * l.y; }, 200) / k_pi;
        };
        double mean = 0;
        constexpr int k_rings = 45;
        for (int i = 0; i < k_rings; ++i) {
            const double degrees = (i + 0.5) * 90 / k_rings;
            mean += albedo(at(degrees)) * std::sin(2 * degrees * k_pi / 180) * k_pi / 2 / k_rings;
        }
        const auto model = eon(r, k_rho);
        for (const double light : {10.0, 45.0, 80.0}) {
            for (const double observer : {0.0, 60.0}) {
                for (const double phi : {0.0, 70.0, 180.0}) {
                    const Double3 l = at(light), v = at(observer, phi);
                    const double often =
                        often_color(k_rho, mean) * (1 - albedo(l)) * (1 - albedo(v)) / (1 - mean);
                    INFO("roughness " << r << ", light " << light << ", observer " << observer << ", phi "
                                      << phi);
                    CHECK(agree(seen(*model, v, l), l.y * (k_rho * once(k_n, v, l, r) + often), 1e-3));
                }
            }
        }
    }
}

TEST_CASE("reflection/eon has an albedo of light reflected once within 0.1 % of the paper's polynomial fit") {
    constexpr std::array k_fit = {0.0571085289, 0.491881867, -0.332181442, 0.0714429953};
    constexpr double k_rho = 0.5;
    for (const double r : {0.3, 1.0}) {
        const double often = often_color(k_rho, once_mean(r));
        const auto model = eon(r, k_rho);
        for (const double degrees : {0.0, 25.0, 50.0, 70.0, 85.0}) {
            const Double3 v = at(degrees);
            double g_over_pi = 0;
            for (std::size_t i = 0; i < k_fit.size(); ++i)
                g_over_pi += k_fit[i] * std::pow(1 - v.y, static_cast<double>(i) + 1);
            INFO("roughness " << r << ", seen at " << degrees << " degrees");
            const double single = (directional_albedo(*model, rounded(v)) - often) / (k_rho - often);
            CHECK(agree(single, scale(r) * (1 + r * g_over_pi), 1e-3));
        }
    }
}

TEST_CASE("reflection/eon at its roughest, lit and seen from above, is 1.0752 times as bright as Lambert") {
    // A = 0.77652, G = 0, so E = A; E_m = 0.83281: A + (1 - A)^2 / (1 - E_m).
    CHECK(agree(seen(*eon(1), at(0), at(0)), 1.07524, 1e-4));
    // Grey facets: rho_m = rho^2 E_m / (1 - rho (1 - E_m)) is 0.22719 for rho = 0.5.
    CHECK(agree(seen(*eon(1, 0.5), at(0), at(0)), 0.5 * 0.776522 + 0.227195 * 0.298718, 1e-4));
}

TEST_CASE("reflection/eon is brighter back towards the light than Lambert, and darker on the far side") {
    const double lambert = std::cos(75 * k_pi / 180);
    CHECK(seen(*eon(1), at(75), at(75)) > 1.5 * lambert);
    CHECK(seen(*eon(1), at(75, 180), at(75)) < 0.4 * lambert);
}
