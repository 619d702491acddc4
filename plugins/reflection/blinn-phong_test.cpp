#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;

TEST_CASE(
    "reflection/blinn-phong is IM4: k_s I_L max(N.H, 0)^alpha where N.L > 0, and Lambert's diffuse light") {
    for (const double shininess : {0.0, 1.0, 10.0, 32.0, 150.0}) {
        INFO("shininess " << shininess);
        const auto model =
            instance<ReflectionModel>("blinn-phong", {{"kd", 0.6}, {"ks", 0.4}, {"shininess", shininess}});
        check_reflection(
            *model,
            [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                const double cosine = dot(n, l);
                if (cosine <= 0) return {};
                const Double3 half = unit(l + v);
                const double h = 0.4 * std::pow(std::max(dot(n, half), 0.0), shininess);
                return {0.6 * cosine * color, {h, h, h}};
            },
            1e-5 + 1e-6 * shininess);
    }
}

TEST_CASE("IM4: in one plane, the angle between R and V is twice that between N and H") {
    const auto blinn =
        instance<ReflectionModel>("blinn-phong", {{"kd", 0.0}, {"ks", 1.0}, {"shininess", 1.0}});
    const auto phong = instance<ReflectionModel>("phong", {{"kd", 0.0}, {"ks", 1.0}, {"shininess", 1.0}});
    for (const double to_light : {0.1, 0.5, 1.0}) {
        for (const double to_observer : {-0.9, -0.2, 0.3}) {
            const auto at = [](double angle) {
                return candela::Vec3{static_cast<float>(std::sin(angle)), static_cast<float>(std::cos(angle)),
                                     0};
            };
            const ReflectionSample sample{{0, 1, 0}, at(to_observer), at(to_light), {1, 1, 1}, {1, 1, 1}};
            const double psi = std::acos(reflect(*blinn, {sample}, {1, 1, 1})[0].specular.x);
            const double phi = std::acos(reflect(*phong, {sample}, {1, 1, 1})[0].specular.x);
            CHECK(agree(phi, 2 * psi, 1e-3, 2e-3));
        }
    }
}
