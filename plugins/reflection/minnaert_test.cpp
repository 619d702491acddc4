#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/microfacets.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

TEST_CASE(
    "reflection/minnaert is k_d C_o (N.L)^k (N.V)^(k - 1), and Lambert's law for k = 1 (Minnaert 1941)") {
    for (const double k : {0.5, 0.8, 1.0, 2.0, 4.0}) {
        INFO("k " << k);
        const auto model = instance<ReflectionModel>("minnaert", {{"kd", 0.8}, {"k", k}});
        check_reflection(
            *model,
            [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                const double light = dot(n, l), observer = std::max(dot(n, v), 0.02);
                if (light <= 0) return {};
                // Cosines are clamped to at least 0.02.
                const double factor =
                    light * std::pow(std::max(light, 0.02), k - 1) * std::pow(observer, k - 1);
                return {0.8 * factor * color, {}};
            },
            1e-4);
    }
}

TEST_CASE("reflection/minnaert with k = 1/2 shows the full moon as a disc of even brightness") {
    // Light from behind the observer: (N.L)^k (N.V)^(k - 1) = (N.L)^(2k - 1) = 1.
    const auto moon = instance<ReflectionModel>("minnaert", {{"kd", 1.0}, {"k", 0.5}});
    for (const double cosine : {1.0, 0.7, 0.3, 0.05}) {
        const auto sine = static_cast<float>(std::sqrt(1 - cosine * cosine));
        const candela::Vec3 l{sine, static_cast<float>(cosine), 0};
        const auto seen = reflect(*moon, {{{0, 1, 0}, l, l, {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1})[0].diffuse;
        CHECK(agree(static_cast<double>(seen.x), 1, 1e-4));
    }
}

TEST_CASE(
    "reflection/minnaert sends 2 (N.V)^(k - 1) / (k + 1) of uniform light from everywhere to an observer") {
    // The integral of (N.L)^k / pi over the hemisphere is 2 / (k + 1): above 1 for k < 1 and an observer at a
    // grazing angle, so not bounded.
    for (const double k : {0.5, 1.0, 2.5}) {
        const auto model = instance<ReflectionModel>("minnaert", {{"kd", 1.0}, {"k", k}});
        for (const double cosine : {1.0, 0.5, 0.1}) {
            const candela::Vec3 v{static_cast<float>(std::sqrt(1 - cosine * cosine)),
                                  static_cast<float>(cosine), 0};
            INFO("k " << k << ", N.V " << cosine);
            CHECK(agree(directional_albedo(*model, v), 2 * std::pow(cosine, k - 1) / (k + 1), 1e-3));
        }
    }
}
