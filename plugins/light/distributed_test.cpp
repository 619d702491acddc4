#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;
using candela::Vec3Arrays;

namespace {

/// The light that one receiver gets from sample `index`.
IncidentSample sample_at(const Light& light, int index, Vec3 position, Vec3 normal = {0, 1, 0}) {
    IncidentSample result;
    const auto in = [](const Vec3& v) { return candela::ConstVec3Span{&v.x, &v.y, &v.z}; };
    const auto out = [](Vec3& v) { return candela::Vec3Span{&v.x, &v.y, &v.z}; };
    light.illuminate(index, {1, in(position), in(normal)},
                     {out(result.to_light), out(result.diffuse), out(result.specular)});
    return result;
}

/// The sum over the samples of what a matt surface reflects, max(N.L, 0) I: the irradiance.
double irradiance(const Light& light, Vec3 position, Vec3 normal) {
    double sum = 0;
    for (int i = 0; i < light.sample_count(); ++i) {
        const IncidentSample s = sample_at(light, i, position, normal);
        sum += std::max(dot(exact(s.to_light), exact(normal)), 0.0) * s.diffuse.x;
    }
    return sum;
}

/// The irradiance from a continuous rectangle of intensity 1: the mean over its area of max(N.d, 0) / |d|^3,
/// with d from the receiver to the source, by five-point Gauss-Legendre quadrature in each of 40 x 40 parts.
double exact_irradiance(Double3 middle, Double3 edge_u, Double3 edge_v, Double3 position, Double3 normal) {
    constexpr int k_parts = 40;
    const double a = std::sqrt(5 - 2 * std::sqrt(10.0 / 7)) / 3,
                 b = std::sqrt(5 + 2 * std::sqrt(10.0 / 7)) / 3;
    const double wa = (322 + 13 * std::sqrt(70.0)) / 900, wb = (322 - 13 * std::sqrt(70.0)) / 900;
    const double node[5] = {-b, -a, 0, a, b}, weight[5] = {wb, wa, 128.0 / 225, wa, wb};
    const auto at = [&](int part, int k) { return (part + 0.5 + 0.5 * node[k]) / k_parts - 0.5; };
    double sum = 0;
    for (int i = 0; i < k_parts * 5; ++i) {
        for (int j = 0; j < k_parts * 5; ++j) {
            const Double3 d = middle + at(i / 5, i % 5) * edge_u + at(j / 5, j % 5) * edge_v - position;
            sum += weight[i % 5] * weight[j % 5] * std::max(dot(d, normal), 0.0) / std::pow(length(d), 3);
        }
    }
    return sum / (4.0 * k_parts * k_parts);
}

std::unique_ptr<Light> panel(std::int64_t samples) {
    return instance<Light>("distributed", {{"position", Vec3{0.5, 2, -0.5}},
                                           {"edge_u", Vec3{2, 0, 0.5}},
                                           {"edge_v", Vec3{0, 0.5, 1}},
                                           {"samples_u", samples},
                                           {"samples_v", samples}});
}

double panel_error(std::int64_t samples, Vec3 position, Vec3 normal) {
    const double expected =
        exact_irradiance({0.5, 2, -0.5}, {2, 0, 0.5}, {0, 0.5, 1}, exact(position), exact(normal));
    return std::abs(irradiance(*panel(samples), position, normal) / expected - 1);
}

}  // namespace

TEST_CASE(
    "light/distributed places point lights at the centres of its equal parts and shares its intensity among "
    "them (RE)") {
    const auto light = instance<Light>("distributed", {{"position", Vec3{1, 2, -0.5}},
                                                       {"edge_u", Vec3{1.5, 0, -3}},
                                                       {"edge_v", Vec3{0, 2, 0.5}},
                                                       {"samples_u", std::int64_t{3}},
                                                       {"samples_v", std::int64_t{2}},
                                                       {"color", Vec3{255, 127.5f, 51}},
                                                       {"intensity", 12.0},
                                                       {"attenuation", std::string("offset-linear")},
                                                       {"attenuation_offset", 0.25}});
    REQUIRE(light->sample_count() == 6);
    CHECK_FALSE(test_registry().descriptor(candela::PluginKind::light, "distributed").has_ambient);
    // Column by column along edge_u, then the next row along edge_v.
    int index = 0;
    for (const double v : {-0.25, 0.25}) {
        for (const double u : {-1.0 / 3, 0.0, 1.0 / 3}) {
            const Double3 from = Double3{1, 2, -0.5} + u * Double3{1.5, 0, -3} + v * Double3{0, 2, 0.5};
            each_way([&](std::size_t size) {
                Random random(static_cast<unsigned>(size));
                Vec3Arrays position, normal, to_light, diffuse, specular;
                for (Vec3Arrays* arrays : {&position, &normal, &to_light, &diffuse, &specular})
                    arrays->resize(size);
                for (std::size_t i = 0; i < size; ++i) position.span().set(i, random.point(5));
                light->illuminate(index, {size, position.span(), normal.span()},
                                  {to_light.span(), diffuse.span(), specular.span()});
                for (std::size_t i = 0; i < size; ++i) {
                    const Double3 d = from - exact(position.span()[i]);
                    const double sent = 12.0 / 6 / (length(d) + 0.25);
                    REQUIRE(agree(to_light.span()[i], unit(d), 1e-5, 1e-5));
                    REQUIRE(agree(diffuse.span()[i], sent * Double3{1, 0.5, 0.2}, 1e-5));
                    REQUIRE(specular.span()[i] == diffuse.span()[i]);
                }
            });
            ++index;
        }
    }
}

TEST_CASE("light/distributed with one sample equals light/point to the last bit") {
    for (const char* const law : {"inverse-square", "offset-linear", "none"}) {
        const Given shared = {{"position", Vec3{1, 2, -0.5f}},
                              {"color", Vec3{255, 128, 51}},
                              {"intensity", 20.0},
                              {"attenuation", std::string(law)}};
        const auto point = instance<Light>("point", shared);
        const auto one = instance<Light>("distributed", {{"position", Vec3{1, 2, -0.5f}},
                                                         {"color", Vec3{255, 128, 51}},
                                                         {"intensity", 20.0},
                                                         {"attenuation", std::string(law)},
                                                         {"edge_u", Vec3{3, -2, 1}},
                                                         {"edge_v", Vec3{0.1f, 5, 0}},
                                                         {"samples_u", std::int64_t{1}}});
        REQUIRE(one->sample_count() == 1);
        each_way([&](std::size_t size) {
            Random random(static_cast<unsigned>(size));
            std::vector<Vec3> positions;
            for (std::size_t i = 0; i < size; ++i) positions.push_back(random.point(5));
            const auto expected = illuminate(*point, positions), got = illuminate(*one, positions);
            for (std::size_t i = 0; i < size; ++i) {
                REQUIRE(got[i].to_light == expected[i].to_light);
                REQUIRE(got[i].diffuse == expected[i].diffuse);
                REQUIRE(got[i].specular == expected[i].specular);
            }
        });
    }
}

TEST_CASE("light/distributed converges to the integral over the rectangle as the samples increase") {
    struct Receiver {
        Vec3 position, normal;
    };
    // Receivers below the panel, next to it, close to it, and one that sees only part of it.
    for (const auto& [position, normal] :
         {Receiver{{0, 0, 0}, {0, 1, 0}}, Receiver{{3, 1, 1}, {-0.8f, 0.6f, 0}},
          Receiver{{0.5f, 1.5f, -0.5f}, {0, 1, 0}}, Receiver{{0.6f, 1.0f, -0.5f}, {1, 0, 0}}}) {
        INFO("at " << text(position) << ", normal " << text(normal));
        const double coarse = panel_error(4, position, normal);
        const double fine = panel_error(64, position, normal);
        INFO("4 x 4 samples: " << coarse << ", 64 x 64: " << fine);
        CHECK(fine < 1e-3);
        CHECK(fine < coarse);
    }
    // The midpoint rule on a smooth integrand: a quarter of the error for half the step.
    const double ratio = panel_error(8, {0, 0, 0}, {0, 1, 0}) / panel_error(16, {0, 0, 0}, {0, 1, 0});
    CHECK(ratio > 3.8);
    CHECK(ratio < 4.2);
}

TEST_CASE("light/distributed: a line seen from its foot matches the closed form of its integral") {
    // Intensity 1 on z = -a ... a at height h, seen from below its middle, N up:
    // 1/(2a) integral of h / (h^2 + z^2)^(3/2) dz = 1 / (h sqrt(h^2 + a^2)).
    constexpr double a = 1.5, h = 0.7;
    const auto line = instance<Light>(
        "distributed",
        {{"position", Vec3{0, 0.7f, 0}}, {"edge_u", Vec3{0, 0, 3}}, {"samples_u", std::int64_t{64}}});
    REQUIRE(line->sample_count() == 64);
    CHECK(agree(irradiance(*line, {0, 0, 0}, {0, 1, 0}), 1 / (h * std::sqrt(h * h + a * a)), 1e-4));
}

TEST_CASE("light/distributed looks from far away like a point light of its intensity") {
    const auto light = panel(6);
    const auto point = instance<Light>("point", {{"position", Vec3{0.5, 2, -0.5}}});
    const double size = std::sqrt(4.25);  // of the longer edge, which bounds the error
    for (const double distance : {20.0, 200.0, 2000.0}) {
        const Double3 away = unit(Double3{1, -2, 0.5});
        const Double3 p = Double3{0.5, 2, -0.5} + distance * away;
        const Vec3 position{static_cast<float>(p.x), static_cast<float>(p.y), static_cast<float>(p.z)};
        const Vec3 normal{static_cast<float>(-away.x), static_cast<float>(-away.y),
                          static_cast<float>(-away.z)};
        const double relative = std::max(2 * std::pow(size / distance, 2), 2e-6);
        CHECK(agree(irradiance(*light, position, normal), irradiance(*point, position, normal), relative));
    }
}

TEST_CASE(
    "light/distributed stays finite on its own samples, with edges of no length and at the ends of all "
    "ranges") {
    const auto finite = [](const Light& light, Vec3 position) {
        for (int i = 0; i < light.sample_count(); ++i) {
            const IncidentSample s = sample_at(light, i, position);
            REQUIRE(std::isfinite(s.diffuse.x));
            REQUIRE(s.diffuse.x >= 0);
            REQUIRE(agree(length(exact(s.to_light)), 1, 1e-6));
        }
    };
    for (const char* const law : {"inverse-square", "offset-linear", "none"}) {
        for (const Vec3 edge : {Vec3{}, Vec3{1, 0, 0}, Vec3{1e-30f, 0, 0}, Vec3{1000, -1000, 1000}}) {
            for (const Vec3 other : {Vec3{}, edge, -edge, Vec3{0, 1000, 0}}) {
                const auto light = instance<Light>("distributed", {{"position", Vec3{1, 1, 1}},
                                                                   {"edge_u", edge},
                                                                   {"edge_v", other},
                                                                   {"samples_u", std::int64_t{3}},
                                                                   {"samples_v", std::int64_t{64}},
                                                                   {"intensity", 1e20},
                                                                   {"attenuation", std::string(law)},
                                                                   {"attenuation_offset", 0.0}});
                INFO(law << ", edges " << text(edge) << " " << text(other));
                for (const Vec3 position : {Vec3{1, 1, 1}, Vec3{1 + 1e-7f, 1, 1}, Vec3{}})
                    finite(*light, position);
            }
        }
    }
}
