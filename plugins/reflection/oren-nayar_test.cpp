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

struct Angles {
    double i, r, dphi;  // of light and observer from N; between their planes
};

Angles angles_of(Double3 n, Double3 v, Double3 l) {
    const Double3 l_flat = l - dot(n, l) * n, v_flat = v - dot(n, v) * n;
    return {std::acos(std::min(dot(n, l), 1.0)), std::acos(std::min(dot(n, v), 1.0)),
            std::atan2(length(cross(l_flat, v_flat)), dot(l_flat, v_flat))};
}

// Oren and Nayar's (1994) functions of angles, for a surface of reflectance rho, as factors of rho
// cos(theta_i).

double qualitative(const Angles& a, double sigma) {
    const double s2 = sigma * sigma;
    return 1 - 0.5 * s2 / (s2 + 0.33) +
           0.45 * s2 / (s2 + 0.09) * std::max(0.0, std::cos(a.dphi)) * std::sin(std::max(a.i, a.r)) *
               std::tan(std::min(a.i, a.r));
}

double full(const Angles& a, double sigma, double rho) {
    const double s2 = sigma * sigma, alpha = std::max(a.i, a.r), beta = std::min(a.i, a.r);
    const double c1 = 1 - 0.5 * s2 / (s2 + 0.33);
    double c2 = 0.45 * s2 / (s2 + 0.09);
    c2 *= std::cos(a.dphi) >= 0 ? std::sin(alpha) : std::sin(alpha) - std::pow(2 * beta / k_pi, 3);
    const double c3 = 0.125 * s2 / (s2 + 0.09) * std::pow(4 * alpha * beta / (k_pi * k_pi), 2);
    const double once = c1 + std::cos(a.dphi) * c2 * std::tan(beta) +
                        (1 - std::abs(std::cos(a.dphi))) * c3 * std::tan((alpha + beta) / 2);
    const double twice =
        0.17 * rho * s2 / (s2 + 0.13) * (1 - std::cos(a.dphi) * std::pow(2 * beta / k_pi, 2));
    return std::max(once + twice, 0.0);
}

/// Fujii's formula (2012), in his own terms.
double fujii(Double3 n, Double3 v, Double3 l, double sigma, double rho) {
    const double s2 = sigma * sigma, s = dot(l, v) - dot(n, l) * dot(n, v);
    const double t = s <= 0 ? 1 : std::max(dot(n, l), dot(n, v));
    return 1 - 0.5 * s2 / (s2 + 0.33) + 0.17 * rho * s2 / (s2 + 0.13) + 0.45 * s2 / (s2 + 0.09) * s / t;
}

std::unique_ptr<ReflectionModel> oren_nayar(const std::string& form, double degrees, double kd = 0.8) {
    return instance<ReflectionModel>("oren-nayar", {{"form", form}, {"sigma", degrees}, {"kd", kd}});
}

/// Light reflected once by Lambertian facets in V-shaped grooves that hide and shade one another, relative to
/// rho cos(theta_i): the integral (Oren, Nayar 1994) that the full form approximates. The facets' angles from
/// N are normally distributed.
double grooves(Double3 v, Double3 l, double sigma) {
    const auto share = [&](Double3 a) { return std::exp(-std::pow(std::acos(a.y) / sigma, 2) / 2); };
    const double sum = over_hemisphere(
        [&](Double3 a) {
            const double l_a = dot(l, a), v_a = dot(v, a);
            if (l_a <= 0 || v_a <= 0) return 0.0;
            const double seen_and_lit = std::min({1.0, 2 * l.y * a.y / l_a, 2 * v.y * a.y / v_a});
            return share(a) * l_a * v_a / (a.y * v.y) * seen_and_lit;
        },
        200);
    return sum / over_hemisphere(share, 200) / l.y;
}

/// The reflected light in the plane of incidence, relative to that at normal incidence on Lambert's surface.
double seen(const ReflectionModel& model, double light_degrees, double observer_degrees) {
    const auto towards = [](double degrees) {
        return Vec3{static_cast<float>(std::sin(degrees * k_pi / 180)),
                    static_cast<float>(std::cos(degrees * k_pi / 180)), 0};
    };
    const ReflectionSample sample{
        {0, 1, 0}, towards(observer_degrees), towards(light_degrees), {1, 1, 1}, {1, 1, 1}};
    return static_cast<double>(reflect(model, {sample}, {1, 1, 1})[0].diffuse.x);
}

}  // namespace

TEST_CASE("reflection/oren-nayar is the paper's function of angles in each form and at each roughness") {
    for (const double degrees : {0.0, 10.0, 30.0, 60.0, 90.0}) {
        for (const std::string form : {"full", "qualitative", "fujii"}) {
            INFO(form << ", sigma " << degrees << " degrees");
            const double sigma = degrees * k_pi / 180;
            check_reflection(
                *oren_nayar(form, degrees),
                [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                    const double cosine = dot(n, l);
                    if (cosine <= 0) return {};
                    // There is no observer behind the surface; the cosine is clamped to zero.
                    const Double3 above = dot(n, v) < 0 ? v - dot(n, v) * n : v;
                    const Angles a = angles_of(n, above, l);
                    const auto channel = [&](double c) {
                        const double rho = 0.8 * c;
                        const double factor = form == "full"          ? full(a, sigma, rho)
                                              : form == "qualitative" ? qualitative(a, sigma)
                                                                      : fujii(n, above, l, sigma, rho);
                        return rho * cosine * factor;
                    };
                    return {{channel(color.x), channel(color.y), channel(color.z)}, {}};
                },
                2e-4);
        }
    }
}

TEST_CASE("reflection/oren-nayar without roughness is Lambert's law in every form") {
    for (const std::string form : {"full", "qualitative", "fujii"}) {
        check_reflection(
            *oren_nayar(form, 0),
            [&](Double3 n, Double3, Double3 l, Double3 color) -> ExactPair {
                return {std::max(dot(n, l), 0.0) * 0.8 * color, {}};
            },
            1e-5);
    }
}

TEST_CASE(
    "reflection/oren-nayar has the coefficients A and B that follow from sigma = 30 degrees: 0.7731 and "
    "0.3388") {
    // sigma^2 = 0.27416: A = 1 - 0.13708 / 0.60416, B = 0.12337 / 0.36416. Seen from above, and along the
    // light.
    const auto model = oren_nayar("qualitative", 30, 0.9);
    CHECK(agree(seen(*model, 0, 0), 0.9 * 0.7731, 1e-4));
    CHECK(agree(seen(*model, 60, 0), 0.9 * 0.5 * 0.7731, 1e-4));
    // Back along the light at 60 degrees: A + B sin(60) tan(60) = A + 1.5 B.
    CHECK(agree(seen(*model, 60, 60), 0.9 * 0.5 * (0.7731 + 1.5 * 0.3388), 1e-4));
    // On the far side only A remains.
    CHECK(agree(seen(*model, 60, -60), 0.9 * 0.5 * 0.7731, 1e-4));
}

TEST_CASE(
    "reflection/oren-nayar is brighter back towards the light than Lambert, and darker on the far side") {
    for (const std::string form : {"full", "qualitative", "fujii"}) {
        const auto rough = oren_nayar(form, 40, 0.9);
        const double lambert = 0.9 * std::cos(75 * k_pi / 180);
        CHECK(seen(*rough, 75, 75) > 1.2 * lambert);
        CHECK(seen(*rough, 75, -75) < 0.9 * lambert);
    }
}

TEST_CASE(
    "reflection/oren-nayar's full form follows the integral over V-shaped grooves that it approximates, to 7 "
    "%") {
    // A dark surface, where interreflection between facets is negligible.
    constexpr double k_dark = 0.01;
    const auto at = [](double theta, double phi) {
        return Double3{std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
    };
    const auto rounded = [](Double3 d) {
        return Vec3{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    };
    for (const double degrees : {20.0, 30.0, 40.0}) {
        const auto model = oren_nayar("full", degrees, k_dark);
        for (const double light : {20.0, 45.0, 60.0}) {
            for (const double observer : {30.0, 60.0}) {
                for (const double dphi : {0.0, 90.0, 180.0}) {
                    const Double3 l = at(light * k_pi / 180, 0);
                    const Double3 v = at(observer * k_pi / 180, dphi * k_pi / 180);
                    const auto seen = reflect(
                        *model, {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1});
                    INFO("sigma " << degrees << ", light " << light << ", observer " << observer << ", dphi "
                                  << dphi);
                    CHECK(agree(static_cast<double>(seen[0].diffuse.x) / k_dark / l.y,
                                grooves(v, l, degrees * k_pi / 180), 0.07));
                }
            }
        }
    }
}

TEST_CASE(
    "reflection/oren-nayar sends out at most what it receives, even along the surface, and little less") {
    // Slightly rough surfaces have the largest sums over light from everywhere.
    const auto albedo = [](const std::string& form, double sigma, double degrees) {
        const double theta = degrees * k_pi / 180;
        return directional_albedo(*oren_nayar(form, sigma, 0.95), {static_cast<float>(std::sin(theta)),
                                                                   static_cast<float>(std::cos(theta)), 0});
    };
    for (const std::string form : {"full", "qualitative", "fujii"}) {
        for (const double sigma : {10.0, 14.0, 18.0, 25.0}) {
            for (const double degrees : {0.0, 60.0, 80.0, 88.0, 89.9}) {
                INFO(form << ", sigma " << sigma << ", seen at " << degrees << " degrees");
                CHECK(albedo(form, sigma, degrees) < 1);
            }
        }
    }
    CHECK(albedo("full", 18, 89.9) > 0.98);
}
