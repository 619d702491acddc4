#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

TEST_CASE("reflection/half-lambert is k_d C_o (N.L / 2 + 1/2)^n on both sides of the horizon (IM2)") {
    for (const double exponent : {1.0, 2.0, 3.5}) {
        const auto model = instance<ReflectionModel>("half-lambert", {{"kd", 0.6}, {"exponent", exponent}});
        check_reflection(
            *model,
            [&](Double3 n, Double3, Double3 l, Double3 color) -> ExactPair {
                return {0.6 * std::pow(0.5 * dot(n, l) + 0.5, exponent) * color, {}};
            },
            // At grazing light from behind, the base is a small difference of two numbers close to one half.
            exponent * 2e-5);
    }
}

TEST_CASE("reflection/half-lambert uses the published exponent 2 unless told otherwise") {
    const auto model = instance<ReflectionModel>("half-lambert", {{"kd", 1.0}});
    const auto reflected =
        reflect(*model, {{{0, 1, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1});
    CHECK(agree(reflected[0].diffuse.x, 0.25, 1e-6));
}
