#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

TEST_CASE(
    "reflection/gooch blends k_cool and k_warm by (1 + N.L) / 2, and adds Phong's highlight (Gooch et al. "
    "1998, "
    "eqs. 2 and 3)") {
    const auto model = instance<ReflectionModel>("gooch", {{"kd", 0.5},
                                                           {"ks", 0.4},
                                                           {"shininess", 12.0},
                                                           {"cool", Vec3{0, 51, 102}},
                                                           {"warm", Vec3{102, 51, 0}},
                                                           {"alpha", 0.25},
                                                           {"beta", 0.5}});
    check_reflection(
        *model,
        [](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
            const Double3 cool = Double3{0, 0.2, 0.4} + 0.25 * (0.5 * color);
            const Double3 warm = Double3{0.4, 0.2, 0} + 0.5 * (0.5 * color);
            const double w = (1 + dot(n, l)) / 2;
            const Double3 mirrored = 2 * dot(n, l) * n - l;
            const double h = dot(n, l) > 0 ? 0.4 * std::pow(std::max(dot(mirrored, v), 0.0), 12) : 0;
            return {w * warm + (1 - w) * cool, {h, h, h}};
        },
        3e-5);
}

TEST_CASE(
    "reflection/gooch is wholly warm where it faces the light, wholly cool on the far side, and has no "
    "ambient part") {
    const auto model = instance<ReflectionModel>("gooch", {{"kd", 0.0}, {"ks", 0.0}});
    const auto seen = [&](Vec3 to_light) {
        return reflect(*model, {{{0, 1, 0}, {0, 1, 0}, to_light, {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1})[0]
            .diffuse;
    };
    CHECK(agree(seen({0, 1, 0}), Vec3{80 / 255.0f, 80 / 255.0f, 0}, 1e-6));
    CHECK(agree(seen({0, -1, 0}), Vec3{0, 0, 140 / 255.0f}, 1e-6));
    const auto ambient = reflect_ambient(*model, {{{0, 1, 0}, {0, 1, 0}, {}, {}, {}}}, {1, 1, 1}, {1, 1, 1});
    CHECK(ambient[0] == Vec3{});
}

TEST_CASE(
    "reflection/gooch without blue and yellow is shading from black to k_d on both sides (Gooch et al. 1998, "
    "section "
    "4.2)") {
    // "k_cool is pure black and k_warm = k_d": half of it where N.L = 0.
    const auto model = instance<ReflectionModel>(
        "gooch",
        {{"kd", 0.8}, {"ks", 0.0}, {"cool", Vec3{}}, {"warm", Vec3{}}, {"alpha", 0.0}, {"beta", 1.0}});
    const auto seen = [&](Vec3 to_light) {
        return reflect(*model, {{{0, 1, 0}, {0, 1, 0}, to_light, {1, 1, 1}, {1, 1, 1}}}, {1, 0.5f, 0})[0]
            .diffuse;
    };
    CHECK(agree(seen({0, 1, 0}), Vec3{0.8f, 0.4f, 0}, 1e-6));
    CHECK(agree(seen({1, 0, 0}), Vec3{0.4f, 0.2f, 0}, 1e-6));
    CHECK(agree(seen({0, -1, 0}), Vec3{}, 1e-6));
}
