#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/highlight.h"
#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;

struct Principled {
    double subsurface = 0, metallic = 0, specular = 0.5, specular_tint = 0, roughness = 0.5;
    double anisotropic = 0, sheen = 0, sheen_tint = 0.5, clearcoat = 0, clearcoat_gloss = 1;
};

std::unique_ptr<ReflectionModel> disney(const Principled& p) {
    return instance<ReflectionModel>("disney", {{"subsurface", p.subsurface},
                                                {"metallic", p.metallic},
                                                {"specular", p.specular},
                                                {"specular_tint", p.specular_tint},
                                                {"roughness", p.roughness},
                                                {"anisotropic", p.anisotropic},
                                                {"sheen", p.sheen},
                                                {"sheen_tint", p.sheen_tint},
                                                {"clearcoat", p.clearcoat},
                                                {"clearcoat_gloss", p.clearcoat_gloss}});
}

double mix(double a, double b, double share) { return a + (b - a) * share; }

/// Burley's functions of angles, of the directions from N and of the difference angle between L and H.
struct Angles {
    double l, v, d, h, phi;  // phi: of H from the tangent
};

Angles angles_of(Double3 n, Double3 v, Double3 l) {
    const Double3 h = unit(l + v), u = tangent_at(n);
    const auto from_n = [&](Double3 x) { return std::atan2(length(cross(n, x)), dot(n, x)); };
    return {from_n(l), from_n(v), std::atan2(length(cross(l, v)), dot(l, v)) / 2, from_n(h),
            std::atan2(dot(h, cross(n, u)), dot(h, u))};
}

double schlick(double angle) { return std::pow(1 - std::cos(angle), 5); }

double retroreflection(const Angles& a, double at_90) {
    return (1 + (at_90 - 1) * schlick(a.l)) * (1 + (at_90 - 1) * schlick(a.v));
}

/// Smith's masking for GGX (Walter et al. 2007, eq. 34), for both directions.
double masking(const Angles& a, double alpha) {
    const auto g1 = [&](double angle) {
        return 2 / (1 + std::sqrt(1 + std::pow(alpha * std::tan(angle), 2)));
    };
    return g1(a.l) * g1(a.v);
}

/// Generalised Trowbridge-Reitz distributions with exponents of 2 and 1.
double gtr2(const Angles& a, double alpha_u, double alpha_v) {
    const double slope = std::pow(std::cos(a.phi) / alpha_u, 2) + std::pow(std::sin(a.phi) / alpha_v, 2);
    return 1 / (k_pi * alpha_u * alpha_v * std::pow(std::cos(a.h), 4) *
                std::pow(1 + std::pow(std::tan(a.h), 2) * slope, 2));
}
double gtr1(double angle, double alpha) {
    const double a2 = alpha * alpha;
    return (a2 - 1) / (k_pi * std::log(a2) * (1 + (a2 - 1) * std::pow(std::cos(angle), 2)));
}
double coat_alpha(const Principled& p) { return mix(0.1, 0.001, p.clearcoat_gloss); }

ExactPair burley(const Principled& p, Double3 n, Double3 v, Double3 l, Double3 color) {
    if (dot(n, l) <= 0) return {};
    const Angles a = angles_of(n, v, l);
    const double square = std::pow(std::cos(a.d), 2), cosines = std::cos(a.l) * std::cos(a.v);
    const double base = retroreflection(a, 0.5 + 2 * p.roughness * square) / k_pi;
    const double within =
        1.25 / k_pi *
        (retroreflection(a, p.roughness * square) * (1 / (std::cos(a.l) + std::cos(a.v)) - 0.5) + 0.5);
    const double aspect = std::sqrt(1 - 0.9 * p.anisotropic), r2 = p.roughness * p.roughness;
    const double lobe =
        gtr2(a, r2 / aspect, r2 * aspect) * masking(a, std::pow(0.5 + p.roughness / 2, 2)) / (4 * cosines);
    const double coat = 0.25 * p.clearcoat * gtr1(a.h, coat_alpha(p)) * masking(a, 0.25) / (4 * cosines) *
                        mix(0.04, 1, schlick(a.d));
    const double luminance = 0.3 * color.x + 0.6 * color.y + 0.1 * color.z;
    const auto diffuse = [&](double c) {
        const double sheen = p.sheen * schlick(a.d) * mix(1, c / luminance, p.sheen_tint);
        return k_pi * dot(n, l) * (1 - p.metallic) * (c * mix(base, within, p.subsurface) + sheen);
    };
    const auto specular = [&](double c) {
        const double dielectric = 0.08 * p.specular * mix(1, c / luminance, p.specular_tint);
        return k_pi * dot(n, l) * (lobe * mix(mix(dielectric, c, p.metallic), 1, schlick(a.d)) + coat);
    };
    return {{diffuse(color.x), diffuse(color.y), diffuse(color.z)},
            {specular(color.x), specular(color.y), specular(color.z)}};
}

Double3 at(double degrees, double phi = 0) {
    const double theta = degrees * k_pi / 180;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The light that a surface facing +y reflects.
ReflectedPair seen(const ReflectionModel& model, Double3 v, Double3 l, candela::Rgb color = {1, 1, 1}) {
    const auto rounded = [](Double3 d) {
        return Vec3{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    };
    return reflect(model, {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, color)[0];
}
double diffuse(const ReflectionModel& model, Double3 v, Double3 l) {
    return static_cast<double>(seen(model, v, l).diffuse.x);
}
double specular(const ReflectionModel& model, Double3 v, Double3 l) {
    return static_cast<double>(seen(model, v, l).specular.x);
}

}  // namespace

TEST_CASE("reflection/disney is the sum of Burley's terms, each alone and all together") {
    for (const Principled& p : {
             Principled{},
             Principled{.roughness = 1},
             Principled{.subsurface = 0.7},
             Principled{.metallic = 1, .roughness = 0.3},
             Principled{.specular = 1, .specular_tint = 1, .roughness = 0.4},
             Principled{.metallic = 0.5, .roughness = 0.4, .anisotropic = 1},
             Principled{.specular = 0, .sheen = 1, .sheen_tint = 0.3},
             Principled{.specular = 0, .clearcoat = 1, .clearcoat_gloss = 0},
             Principled{0.4, 0.3, 0.8, 0.5, 0.6, 0.7, 0.6, 0.8, 0.9, 0.5},
         }) {
        INFO("subsurface " << p.subsurface << ", metallic " << p.metallic << ", roughness " << p.roughness
                           << ", sheen " << p.sheen << ", clearcoat " << p.clearcoat);
        check_reflection(
            *disney(p),
            [&](Double3 n, Double3 v, Double3 l, Double3 color) { return burley(p, n, v, l, color); }, 1e-3);
    }
}

TEST_CASE(
    "reflection/disney: diffuse light at grazing angles falls to half and rises to 2.5 times Lambert's") {
    // Seen from above and lit from 80 degrees: W = (1 - cos(80 degrees))^5 = 0.38532, (L.H)^2 = cos^2(40
    // degrees) = 0.58682, so F_90 is 0.5 and 1.67365.
    const auto smooth = disney({.roughness = 0}), rough = disney({.roughness = 1});
    const double lambert = at(80).y;
    CHECK(agree(diffuse(*smooth, at(0), at(80)), lambert * 0.80734, 1e-4));
    CHECK(agree(diffuse(*rough, at(0), at(80)), lambert * 1.25957, 1e-4));
    // Back along the light F_90 is 2.5: (1 + 1.5 * 0.38532)^2.
    CHECK(agree(diffuse(*rough, at(80), at(80)), lambert * 2.49004, 1e-4));
    // The limits, for each of the two directions.
    CHECK(agree(diffuse(*smooth, at(89.99), at(89.99)), at(89.99).y * 0.25, 5e-3));
    CHECK(agree(diffuse(*rough, at(89.99), at(89.99)), at(89.99).y * 6.25, 5e-3));
    // F_90 = 1 where 2 r (L.H)^2 = 1/2: Lambert's law.
    CHECK(agree(diffuse(*disney({.roughness = 0.25}), at(70), at(70)), at(70).y, 1e-4));
}

TEST_CASE(
    "reflection/disney: both distributions of facets integrate to 1 over the hemisphere, seen from above") {
    // Towards the light, H is L and V, and Fresnel's factor is its value at normal incidence.
    const auto facets = [](const Principled& p, double reflected, double alpha_g) {
        const auto model = disney(p);
        const auto share = [&](Double3 h) {
            const Angles a = angles_of({0, 1, 0}, h, h);
            return specular(*model, h, h) * 4 * h.y / (k_pi * reflected * masking(a, alpha_g)) * h.y;
        };
        return over_hemisphere(share, 150);
    };
    CHECK(agree(facets({.specular = 1, .roughness = 0.6, .anisotropic = 0.8}, 0.08, 0.64), 1, 2e-3));
    CHECK(agree(facets({.specular = 1, .roughness = 1}, 0.08, 1), 1, 2e-3));
    CHECK(agree(facets({.specular = 0, .clearcoat = 1, .clearcoat_gloss = 0}, 0.25 * 0.04, 0.25), 1, 5e-3));
}

TEST_CASE("reflection/disney straight on has GGX's highlight with alpha = roughness^2 and 4 % for plastic") {
    // F D / 4 = 0.04 / (4 * 0.25^2) for a roughness of 0.5.
    const auto plastic = disney({});
    const auto ggx = instance<ReflectionModel>("ggx", {{"kd", 0.0}, {"ks", 1.0}, {"roughness", 0.25}});
    CHECK(agree(specular(*plastic, at(0), at(0)), 0.16, 1e-4));
    CHECK(agree(specular(*plastic, at(0), at(0)), specular(*ggx, at(0), at(0)), 1e-4));
    for (const double degrees : {2.0, 5.0, 8.0})
        CHECK(agree(specular(*plastic, at(-degrees), at(3 * degrees)),
                    specular(*ggx, at(-degrees), at(3 * degrees)), 0.03));
}

TEST_CASE("reflection/disney: metal has no diffuse light, and highlights in its colour") {
    const ReflectedPair metal =
        seen(*disney({.metallic = 1, .roughness = 0.4}), at(0), at(0), {0.9f, 0.6f, 0.2f});
    CHECK(metal.diffuse == Vec3{});
    CHECK(agree(static_cast<double>(metal.specular.y / metal.specular.x), 0.6 / 0.9, 1e-5));
    CHECK(agree(static_cast<double>(metal.specular.z / metal.specular.x), 0.2 / 0.9, 1e-5));
}

TEST_CASE("reflection/disney on a black surface is finite, with colourless tints") {
    const ReflectedPair black =
        seen(*disney({.specular_tint = 1, .sheen = 1, .sheen_tint = 1}), at(60), at(-70), {0, 0, 0});
    CHECK(black.diffuse.x > 0);
    CHECK(black.diffuse.x == black.diffuse.z);
    CHECK(black.specular.x == black.specular.z);
}

TEST_CASE("reflection/disney: an anisotropic highlight is long along u on a rendered ball") {
    const auto spread = [](const std::string& anisotropic) {
        return highlight_aspect("disney",
                                "ka = 0, metallic = 1, roughness = 0.5, anisotropic = " + anisotropic);
    };
    CHECK(spread("1") > 2);
    CHECK(agree(spread("0"), 1, 0.02));
}
