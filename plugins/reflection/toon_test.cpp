#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>
#include <set>

#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

Vec3 at_angle(double degrees) {
    const double a = degrees * std::numbers::pi / 180;
    return {static_cast<float>(std::sin(a)), static_cast<float>(std::cos(a)), 0};
}

ReflectedPair seen(const ReflectionModel& model, double light_degrees, double observer_degrees = 0) {
    return reflect(model,
                   {{{0, 1, 0}, at_angle(observer_degrees), at_angle(light_degrees), {1, 1, 1}, {1, 1, 1}}},
                   {1, 1, 1})[0];
}

}  // namespace

TEST_CASE("reflection/toon has as many steps of brightness as requested, equally spaced in N.L") {
    for (const std::int64_t bands : {1, 2, 5, 16}) {
        const auto model = instance<ReflectionModel>("toon", {{"kd", 1.0}, {"ks", 0.0}, {"bands", bands}});
        std::set<float> levels;
        for (double degrees = 0; degrees < 89.9; degrees += 0.25)
            levels.insert(seen(*model, degrees).diffuse.x);
        INFO(bands << " bands");
        CHECK(levels.size() == static_cast<std::size_t>(bands));
        CHECK(*levels.rbegin() == 1);
        CHECK(agree(static_cast<double>(*levels.begin()), 1.0 / static_cast<double>(bands), 1e-6));
    }
}

TEST_CASE("reflection/toon with two bands changes at 60 degrees, where N.L is 1/2, and is dark beyond 90") {
    const auto model = instance<ReflectionModel>("toon", {{"kd", 0.8}, {"ks", 0.0}});
    CHECK(agree(seen(*model, 59.9).diffuse, Vec3{0.8f, 0.8f, 0.8f}, 1e-6));
    CHECK(agree(seen(*model, 60.1).diffuse, Vec3{0.4f, 0.4f, 0.4f}, 1e-6));
    CHECK(agree(seen(*model, 89.9).diffuse, Vec3{0.4f, 0.4f, 0.4f}, 1e-6));
    CHECK(seen(*model, 90.1).diffuse == Vec3{});
}

TEST_CASE("reflection/toon's highlight ends where the half vector is `highlight` from N") {
    const auto model = instance<ReflectionModel>("toon", {{"ks", 0.6}, {"highlight", 10.0}});
    // The angle to the half vector is half the angle between light and observer.
    CHECK(agree(seen(*model, 50, -30.2).specular, Vec3{0.6f, 0.6f, 0.6f}, 1e-6));
    CHECK(seen(*model, 50, -29.8).specular == Vec3{});
    CHECK(seen(*model, 95, -85).specular == Vec3{});
}

TEST_CASE("reflection/toon has no highlight of 0 degrees, and one of a hundredth of a degree has its size") {
    const auto none = instance<ReflectionModel>("toon", {{"ks", 0.6}, {"highlight", 0.0}});
    const auto tiny = instance<ReflectionModel>("toon", {{"ks", 0.6}, {"highlight", 0.01}});
    for (double degrees = 0; degrees < 89; degrees += 0.5) {
        INFO(degrees << " degrees");
        // The half vector is N, to the last bits.
        CHECK(seen(*none, degrees, -degrees).specular == Vec3{});
        CHECK(seen(*tiny, degrees + 0.009, -degrees + 0.009).specular != Vec3{});
        CHECK(seen(*tiny, degrees + 0.011, -degrees + 0.011).specular == Vec3{});
    }
}
