#include <catch2/catch_test_macros.hpp>
#include <cmath>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

TEST_CASE("reflection/specular-glossiness is GGX with Schlick's factor over what it leaves to Lambert") {
    for (const double glossiness : {0.0, 0.4, 0.7}) {
        const auto model = instance<ReflectionModel>(
            "specular-glossiness",
            {{"specular_color", Vec3{0.25f, 0.5f, 0.125f}}, {"glossiness", glossiness}});
        check_reflection(
            *model,
            [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                if (dot(n, l) <= 0) return {};
                const Double3 h = unit(l + v);
                const double alpha = std::pow(1 - glossiness, 2);
                const auto tangent = [&](Double3 d) { return length(cross(n, d)) / dot(n, d); };
                const auto lambda = [&](Double3 d) {
                    return (std::sqrt(1 + std::pow(alpha * tangent(d), 2)) - 1) / 2;
                };
                const double d = 1 / (std::pow(alpha, 2) * std::pow(dot(n, h), 4) *
                                      std::pow(1 + std::pow(tangent(h) / alpha, 2), 2));
                const double lobe = d / ((1 + lambda(v) + lambda(l)) * 4 * dot(n, v));
                const double w = std::pow(1 - dot(v, h), 5);
                const Double3 f{0.25 + 0.75 * w, 0.5 + 0.5 * w, 0.125 + 0.875 * w};
                return {dot(n, l) * (1 - f.y) * color, lobe * f};
            },
            1e-3);
    }
}

TEST_CASE("reflection/specular-glossiness is metallic-roughness with an infinite index of refraction") {
    const Vec3 specular{0.75f, 0.5f, 0.25f};
    const auto glossy =
        instance<ReflectionModel>("specular-glossiness", {{"specular_color", specular}, {"glossiness", 0.6}});
    const auto rough = instance<ReflectionModel>(
        "metallic-roughness", {{"specular_color", specular}, {"roughness", 0.4}, {"ior", 0.0}});
    Random random(3);
    for (int i = 0; i < 300; ++i) {
        const ReflectionSample s{
            random.direction(), random.direction(), random.direction(), {1, 1, 1}, {1, 1, 1}};
        if (dot(exact(s.normal), exact(s.to_observer)) < 0.01) continue;
        const auto a = reflect(*glossy, {s}, {0.8f, 0.5f, 0.25f}),
                   b = reflect(*rough, {s}, {0.8f, 0.5f, 0.25f});
        CHECK(agree(a[0].diffuse, b[0].diffuse, 1e-4, 1e-6));
        CHECK(agree(a[0].specular, b[0].specular, 1e-4, 1e-6));
    }
}
