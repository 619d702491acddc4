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

/// With the specification's defaults, except a white base.
std::unique_ptr<ReflectionModel> openpbr(
    std::vector<std::pair<std::string_view, candela::Value>> given = {}) {
    candela::ParamSet values = test_registry().parameters(candela::k_kind_of<ReflectionModel>, "openpbr");
    values.set("base_color", 1.0);
    for (const auto& [key, value] : given) values.set(key, value);
    return test_registry().create<ReflectionModel>("openpbr", values, candela::ColorEncoding::none);
}

Double3 at(double degrees, double phi = 0) {
    const double theta = degrees * k_pi / 180;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
}

/// The light that a surface facing +y reflects.
ReflectedPair seen(const ReflectionModel& model, Double3 v, Double3 l, candela::Rgb color = {1, 1, 1}) {
    return reflect(model, {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, color)[0];
}

double single(float x) { return static_cast<double>(x); }

/// The light that a surface reflects to an observer in a white furnace, integrated in rings around the mirror
/// direction, which are narrow where highlights are.
double furnace(const ReflectionModel& model, double degrees) {
    const Double3 v = at(degrees), mirror = at(degrees, k_pi), up{0, 1, 0};
    const Double3 across = degrees < 1 ? Double3{0, 0, 1} : unit(cross(mirror, up)),
                  aside = cross(across, mirror);
    constexpr int k_rings = 120, k_spokes = 96;
    const double nearest = std::log(1e-3), step = (std::log(k_pi) - nearest) / k_rings;
    std::vector<ReflectionSample> samples;
    std::vector<double> weights;
    for (int ring = 0; ring < k_rings; ++ring) {
        const double angle = std::exp(nearest + (ring + 0.5) * step);
        for (int spoke = 0; spoke < k_spokes; ++spoke) {
            const double phi = 2 * k_pi * (spoke + 0.5) / k_spokes;
            const Double3 l =
                std::cos(angle) * mirror + std::sin(angle) * (std::cos(phi) * aside + std::sin(phi) * across);
            if (l.y <= 0) continue;
            samples.push_back({{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}});
            weights.push_back(std::sin(angle) * angle * step * 2 * k_pi / k_spokes);
        }
    }
    const std::vector<ReflectedPair> reflected = reflect(model, samples, {1, 1, 1});
    double sum = 0;
    for (std::size_t i = 0; i < weights.size(); ++i)
        sum += weights[i] * (single(reflected[i].diffuse.x) + single(reflected[i].specular.x)) / k_pi;
    return sum;
}

/// The mean of Fresnel's equations over the hemisphere, by quadrature.
double mean_fresnel(double ior) {
    double sum = 0;
    constexpr int k_steps = 20000;
    for (int i = 0; i < k_steps; ++i) {
        const double cosine = (i + 0.5) / k_steps;
        sum += 2 * cosine * exact_fresnel(cosine, ior) / k_steps;
    }
    return sum;
}

}  // namespace

TEST_CASE("reflection/openpbr: metal reflects its colour at 0 degrees, and Schlick's tinted at 82 (F82)") {
    const Vec3 gold{0.9f, 0.6f, 0.2f}, tint{0.9f, 0.7f, 0.4f};
    const auto metal = openpbr({{"base_metalness", 1.0},
                                {"base_color", gold},
                                {"specular_color", tint},
                                {"specular_roughness", 0.1}}),
               mirror = openpbr({{"base_metalness", 1.0}, {"specular_roughness", 0.1}});
    const auto share = [&](double degrees) {
        const ReflectedPair found = seen(*metal, at(degrees), at(degrees, k_pi)),
                            white = seen(*mirror, at(degrees), at(degrees, k_pi));
        CHECK(found.diffuse == Vec3{});
        return (1 / single(white.specular.x)) * exact(found.specular);
    };
    const double edge = std::acos(1.0 / 7) * 180 / k_pi;
    const auto schlick = [&](double f0) { return f0 + (1 - f0) * std::pow(6.0 / 7, 5); };
    INFO(text(share(0)) << ", " << text(share(edge)));
    CHECK(agree(gold, share(0), 1e-4));
    CHECK(agree(Vec3{static_cast<float>(0.9 * schlick(0.9)), static_cast<float>(0.7 * schlick(0.6)),
                     static_cast<float>(0.4 * schlick(0.2))},
                share(edge), 1e-3));
}

TEST_CASE("reflection/openpbr without a highlight is reflection/eon") {
    for (const double roughness : {0.0, 0.4, 1.0}) {
        const auto model =
            openpbr({{"specular_weight", 0.0}, {"base_weight", 0.5}, {"base_diffuse_roughness", roughness}});
        const auto matt = instance<ReflectionModel>("eon", {{"roughness", roughness}, {"kd", 1.0}});
        Random random(3);
        for (int i = 0; i < 300; ++i) {
            const Vec3 n = random.direction(), v = random.direction(), l = random.direction();
            if (dot(exact(n), exact(v)) < 0.01) continue;
            const ReflectionSample s{n, v, l, {1, 1, 1}, {1, 1, 1}};
            const candela::Rgb color{0.9f, 0.5f, 0.1f};
            const ReflectedPair found = reflect(*model, {s}, color)[0];
            REQUIRE(agree(found.diffuse, 0.5 * exact(reflect(*matt, {s}, color)[0].diffuse), 1e-5));
            REQUIRE(agree(found.specular, Double3{}, 1e-5));
        }
    }
}

TEST_CASE("reflection/openpbr: a white surface reflects all light in a white furnace, to 0.025") {
    for (const double roughness : {0.25, 0.5, 1.0}) {
        for (const double degrees : {0.0, 30.0, 60.0, 75.0, 85.0, 88.0}) {
            INFO("roughness " << roughness << ", seen at " << degrees << " degrees");
            const auto check = [&](std::vector<std::pair<std::string_view, candela::Value>> given) {
                given.emplace_back("specular_roughness", roughness);
                const double share = furnace(*openpbr(given), degrees);
                INFO(given[0].first << ": " << share);
                CHECK(share < 1.01);
                CHECK(share > 0.975);
            };
            for (const double ior : {1.1, 1.5, 2.0, 3.0}) check({{"specular_ior", ior}});
            check({{"base_metalness", 1.0}});
            check({{"base_metalness", 0.5}, {"base_diffuse_roughness", 1.0}});
            check({{"coat_weight", 1.0}, {"coat_roughness", 0.5}});
            check({{"coat_weight", 0.5}, {"coat_roughness", roughness}, {"coat_ior", 2.0}});
            check({{"fuzz_weight", 1.0}, {"fuzz_roughness", 0.3}});
            check({{"fuzz_weight", 0.7}, {"coat_weight", 1.0}, {"coat_roughness", 0.4}});
        }
    }
}

TEST_CASE("reflection/openpbr: the base lacks what the highlight's integral over all lights is, to 0.02") {
    for (const double roughness : {0.25, 0.5, 0.75, 1.0}) {
        for (const double ior : {1.05, 1.33, 1.5, 2.0, 3.0}) {
            for (const double degrees : {0.0, 40.0, 65.0, 80.0, 87.0}) {
                INFO("roughness " << roughness << ", index " << ior << ", " << degrees << " degrees");
                const auto black = openpbr({{"base_weight", 0.0},
                                            {"specular_ior", ior},
                                            {"specular_roughness", roughness}}),
                           white = openpbr({{"specular_ior", ior}, {"specular_roughness", roughness}});
                const double rest = single(seen(*white, at(degrees), at(0)).diffuse.x);
                CHECK(std::abs(1 - rest - furnace(*black, degrees)) < 0.02);
            }
        }
    }
}

TEST_CASE("reflection/openpbr: specular_weight is a factor of the reflectance at normal incidence") {
    const auto highlight = [](double weight, double ior) {
        return single(
            seen(*openpbr({{"specular_weight", weight}, {"specular_ior", ior}}), at(0), at(0)).specular.x);
    };
    // F D pi / 4 = F / (4 alpha^2), with F = 0.04 and alpha = 0.09.
    CHECK(agree(highlight(1, 1.5), 0.04 / (4 * 0.09 * 0.09), 1e-4));
    CHECK(agree(highlight(0.25, 1.5), highlight(1, 1.5) / 4, 1e-4));
    CHECK(agree(highlight(5, 1.5), 5 * highlight(1, 1.5), 1e-4));
    // Four times the reflectance of 1.5 is that of (1 + 0.4) / (1 - 0.4), at any angle.
    const auto doubled = seen(*openpbr({{"specular_weight", 4.0}}), at(70), at(60, 2)),
               other = seen(*openpbr({{"specular_ior", 1.4 / 0.6}}), at(70), at(60, 2));
    CHECK(agree(doubled.specular, exact(other.specular), 1e-4));
    CHECK(agree(doubled.diffuse, exact(other.diffuse), 1e-4));
}

TEST_CASE(
    "reflection/openpbr: a base of the coat's own index has no highlight, and keeps its colour's tint") {
    const auto model = openpbr({{"coat_weight", 1.0}, {"coat_ior", 1.5}, {"coat_roughness", 0.2}});
    const auto bare = openpbr({{"base_weight", 0.0}, {"specular_ior", 1.5}, {"specular_roughness", 0.2}});
    for (const double degrees : {0.0, 40.0, 75.0}) {
        const Double3 v = at(degrees), l = at(degrees / 2, 2);
        CHECK(agree(seen(*model, v, l).specular, exact(seen(*bare, v, l).specular), 1e-5));
    }
    // Both indices may change places: no total reflection below a coat of a higher index.
    const auto low = openpbr({{"coat_weight", 1.0}, {"coat_ior", 1.5}, {"specular_ior", 1.2}}),
               high = openpbr({{"coat_weight", 1.0}, {"coat_ior", 1.5}, {"specular_ior", 1.875}});
    CHECK(agree(seen(*low, at(60), at(60, k_pi)).specular, exact(seen(*high, at(60), at(60, k_pi)).specular),
                1e-4));
}

TEST_CASE("reflection/openpbr: a smooth coat darkens a matt base as internal reflections do") {
    // Interfaced Lambertian: F + E (1 - F) (1 - K) / (1 - E K), K = 1 - (1 - mean of F) / n^2.
    for (const double ior : {1.3, 1.6, 2.2}) {
        const double k = 1 - (1 - mean_fresnel(ior)) / (ior * ior);
        for (const double albedo : {0.2, 0.7, 1.0}) {
            const auto base = [&](double darkening) {
                // It has the index of the coat, so that only its matt part is left.
                const auto model = openpbr({{"base_color", albedo},
                                            {"specular_ior", ior},
                                            {"coat_weight", 1.0},
                                            {"coat_ior", ior},
                                            {"coat_darkening", darkening}});
                return single(seen(*model, at(0), at(0)).diffuse.x);
            };
            const double through = 1 - exact_fresnel(1, ior);
            INFO("index " << ior << ", albedo " << albedo);
            CHECK(agree(base(1), albedo * through * (1 - k) / (1 - albedo * k), 0.01));
            CHECK(agree(base(0), albedo * through, 2e-3));
        }
    }
}

TEST_CASE("reflection/openpbr: at normal incidence a coat's colour tints the base, and more so at the rim") {
    const Vec3 amber{0.8f, 0.5f, 0.1f};
    const auto coated = openpbr({{"coat_weight", 1.0}, {"coat_color", amber}, {"specular_weight", 0.0}}),
               clear = openpbr({{"coat_weight", 1.0}, {"specular_weight", 0.0}});
    const auto tint = [&](double degrees) {
        const Double3 v = at(degrees), l = at(degrees, k_pi);
        return seen(*coated, v, l).diffuse.y / seen(*clear, v, l).diffuse.y;
    };
    CHECK(agree(single(tint(0)), 0.5, 1e-4));
    // 80 degrees is 38 within an index of 1.6.
    CHECK(agree(single(tint(80)), std::pow(0.5, 1 / std::cos(std::asin(std::sin(80 * k_pi / 180) / 1.6))),
                1e-4));
}

TEST_CASE("reflection/openpbr: fuzz reflects the shares of Zeltner, Burley and Chiang's table, to 0.005") {
    struct Entry {
        int mu, alpha;  // in steps of 1/31
        double share;
    };
    for (const Entry& e : {Entry{2, 11, 0.5539},
                           {4, 6, 0.2048},
                           {4, 16, 0.5210},
                           {7, 16, 0.4069},
                           {7, 31, 0.6321},
                           {11, 7, 0.0185},
                           {16, 16, 0.1572},
                           {16, 31, 0.4919},
                           {31, 22, 0.1102},
                           {31, 31, 0.3419}}) {
        const double degrees = std::acos(e.mu / 31.0) * 180 / k_pi, roughness = e.alpha / 31.0;
        const auto fuzzy = openpbr({{"fuzz_weight", 1.0},
                                    {"fuzz_roughness", roughness},
                                    {"base_weight", 0.0},
                                    {"specular_weight", 0.0}}),
                   white = openpbr(
                       {{"fuzz_weight", 1.0}, {"fuzz_roughness", roughness}, {"specular_weight", 0.0}});
        INFO("mu " << e.mu << ", alpha " << e.alpha);
        CHECK(std::abs(1 - single(seen(*white, at(degrees), at(0)).diffuse.x) - e.share) < 0.005);
        CHECK(std::abs(furnace(*fuzzy, degrees) - e.share) < 0.006);
    }
}

TEST_CASE("reflection/openpbr: light and observer may change places at a bare metal") {
    const auto metal = openpbr({{"base_metalness", 1.0}, {"specular_roughness", 0.6}});
    Random random(7);
    for (int i = 0; i < 300; ++i) {
        const Vec3 n = random.direction(), v = random.direction(), l = random.direction();
        const double n_v = dot(exact(n), exact(v)), n_l = dot(exact(n), exact(l));
        if (n_v < 0.02 || n_l < 0.02) continue;
        const candela::Rgb color{0.8f, 0.5f, 0.25f};
        const ReflectedPair forth = reflect(*metal, {{n, v, l, {1, 1, 1}, {1, 1, 1}}}, color)[0],
                            back = reflect(*metal, {{n, l, v, {1, 1, 1}, {1, 1, 1}}}, color)[0];
        REQUIRE(agree(back.specular, n_v / n_l * exact(forth.specular), 1e-4));
    }
}

TEST_CASE("reflection/openpbr: an anisotropic highlight is long along u") {
    const auto spread = [](const std::string& values) {
        return highlight_aspect("openpbr", "ka = 0, base_metalness = 1, specular_roughness = 0.4, " + values);
    };
    CHECK(spread("specular_roughness_anisotropy = 0.6") > 1.5);
    CHECK(agree(spread("specular_roughness_anisotropy = 0"), 1, 0.02));
}
