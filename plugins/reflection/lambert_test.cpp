#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

TEST_CASE("reflection/lambert is k_d C_o max(N.L, 0) and has no highlight (IM1, DD4)") {
    const auto model = instance<ReflectionModel>("lambert", {{"kd", Vec3{0.7f, 0.4f, 0.9f}}});
    check_reflection(
        *model,
        [](Double3 n, Double3, Double3 l, Double3 color) -> ExactPair {
            const double cosine = std::max(dot(n, l), 0.0);
            return {{0.7 * color.x * cosine, 0.4 * color.y * cosine, 0.9 * color.z * cosine}, {}};
        },
        1e-5);
}

TEST_CASE("every reflection model reflects k_a C_o I_ambient, whatever the directions (DD3)") {
    for (const char* const name : {"lambert", "half-lambert", "phong", "blinn-phong"}) {
        INFO(name);
        const auto model = instance<ReflectionModel>(name, {{"ka", Vec3{0.1f, 0.2f, 0.3f}}});
        Random random(1);
        each_way([&](std::size_t size) {
            std::vector<ReflectionSample> samples(size);
            for (ReflectionSample& s : samples) s = {random.direction(), random.direction(), {}, {}, {}};
            for (const Vec3 reflected : reflect_ambient(*model, samples, {0.5f, 0.25f, 1}, {2, 4, 8})) {
                REQUIRE(agree(reflected, Double3{0.1 * 0.5 * 2, 0.2 * 0.25 * 4, 0.3 * 1 * 8}, 1e-6));
            }
        });
    }
}

TEST_CASE("a reflection model adds to the light of earlier sources") {
    const auto model = instance<ReflectionModel>("lambert", {{"kd", 0.5}});
    candela::Vec3Arrays n, sum, other;
    for (auto* arrays : {&n, &sum, &other}) arrays->resize(1);
    n.span().set(0, {0, 1, 0});
    sum.span().set(0, {10, 20, 30});
    candela::Vec3Arrays one;
    one.resize(1);
    one.span().set(0, {1, 1, 1});
    model->reflect({1, n.span(), n.span(), {}, {1, 1, 1}}, {n.span(), one.span(), one.span()},
                   {other.span(), sum.span(), other.span()});
    CHECK(sum.span()[0] == Vec3{10.5f, 20.5f, 30.5f});
}
