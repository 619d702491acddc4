#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

TEST_CASE("reflection/ashikhmin-shirley is pi N.L times the paper's eqs. 4 and 5") {
    for (const double n_u : {1.0, 10.0, 200.0}) {
        for (const double r_s : {0.05, 0.5}) {
            constexpr double k_n_v = 40, k_r_d = 0.6;
            INFO("n_u " << n_u << ", R_s " << r_s);
            const auto model = instance<ReflectionModel>(
                "ashikhmin-shirley",
                {{"kd", k_r_d}, {"ks", r_s}, {"exponent_u", n_u}, {"exponent_v", k_n_v}});
            check_reflection(
                *model,
                [&](Double3 n, Double3 k2, Double3 k1, Double3 color) -> ExactPair {
                    if (dot(n, k1) <= 0) return {};
                    const Double3 h = unit(k1 + k2), u = tangent_at(n), v = cross(n, u);
                    const double pi = std::numbers::pi, nh = std::min(dot(n, h), 1.0);
                    const double exponent =
                        (n_u * std::pow(dot(h, u), 2) + k_n_v * std::pow(dot(h, v), 2)) / (1 - nh * nh);
                    const double fresnel = r_s + (1 - r_s) * std::pow(1 - dot(k1, h), 5);
                    const double specular = std::sqrt((n_u + 1) * (k_n_v + 1)) / (8 * pi) *
                                            std::pow(nh, exponent) /
                                            (dot(h, k1) * std::max(dot(n, k1), dot(n, k2))) * fresnel;
                    const double diffuse = 28 * k_r_d / (23 * pi) * (1 - r_s) *
                                           (1 - std::pow(1 - dot(n, k1) / 2, 5)) *
                                           (1 - std::pow(1 - dot(n, k2) / 2, 5));
                    const double s = pi * specular * dot(n, k1);
                    return {pi * diffuse * dot(n, k1) * color, {s, s, s}};
                },
                1e-3);
        }
    }
}

TEST_CASE(
    "reflection/ashikhmin-shirley reflects everything that R_d = 1 and R_s = 0 allow, seen from above, up to "
    "the gloss") {
    // The paper's 28/23 makes the diffuse albedo largest for k_2 = n: 28/23 * 31/32 * 23/28 = 31/32.
    const auto model = instance<ReflectionModel>("ashikhmin-shirley", {{"kd", 1.0}, {"ks", 0.0}});
    double albedo = 0;
    constexpr int k_steps = 20000;
    for (int i = 0; i < k_steps; ++i) {
        const double theta = (i + 0.5) / k_steps * std::numbers::pi / 2;
        const ReflectionSample sample{
            {0, 1, 0},
            {0, 1, 0},
            {static_cast<float>(std::sin(theta)), static_cast<float>(std::cos(theta)), 0},
            {1, 1, 1},
            {0, 0, 0}};
        if (i % 20 != 0) continue;
        albedo += 2 * std::sin(theta) *
                  static_cast<double>(reflect(*model, {sample}, {1, 1, 1})[0].diffuse.x) *
                  (std::numbers::pi / 2) * 20 / k_steps;
    }
    CHECK(agree(albedo, 31.0 / 32, 2e-3));
}
