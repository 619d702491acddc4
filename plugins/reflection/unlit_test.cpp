#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

TEST_CASE("reflection/unlit has its colour in ambient light, and reflects no other") {
    const auto model = instance<ReflectionModel>("unlit", {{"ka", 2.0}});
    check_reflection(*model, [](Double3, Double3, Double3, Double3) { return ExactPair{}; }, 1e-6);
    const std::vector<Vec3> seen =
        reflect_ambient(*model, {{{0, 1, 0}, {0, 1, 0}, {0, 1, 0}, {1, 1, 1}, {1, 1, 1}}},
                        {0.8f, 0.5f, 0.25f}, {0.5f, 0.5f, 1});
    CHECK(agree(seen[0], Double3{0.8, 0.5, 0.5}, 1e-6));
}
