#include <catch2/catch_test_macros.hpp>

#include "support/plugins.h"
#include "support/samples.h"

using candela::Light;
using candela::Vec3;

namespace {

constexpr Double3 k_position{1, 2, -0.5};

/// A light at k_position, and the light it must send.
void check_law(const char* law, const std::function<double(double)>& attenuation) {
    INFO(law);
    const auto light = instance<Light>("point", {{"position", Vec3{1, 2, -0.5f}},
                                                 {"color", Vec3{255, 127.5f, 51}},
                                                 {"intensity", 20.0},
                                                 {"attenuation", std::string(law)},
                                                 {"attenuation_offset", 0.25}});
    check_light(
        *light,
        [&](Double3 p) -> ExactIncident {
            const Double3 d = k_position - p;
            const double i = 20 * attenuation(length(d));
            return {unit(d), {i, 0.5 * i, 0.2 * i}};
        },
        1e-5);
}

}  // namespace

TEST_CASE("light/point fades with 1/r^2 (DD7), 1/(r + k) (RE) or not at all") {
    check_law("inverse-square", [](double r) { return 1 / (r * r); });
    check_law("offset-linear", [](double r) { return 1 / (r + 0.25); });
    check_law("none", [](double) { return 1.0; });
}

TEST_CASE("light/point stays finite where a surface passes through it") {
    for (const char* const law : {"inverse-square", "offset-linear", "none"}) {
        const auto light =
            instance<Light>("point", {{"position", Vec3{1, 1, 1}}, {"attenuation", std::string(law)}});
        for (const float distance : {0.0f, 1e-30f, 1e-20f, 1e-7f}) {
            INFO(law << " at " << distance);
            const auto incident = illuminate(*light, {Vec3{1 + distance, 1, 1}}, {0, 0, 1})[0];
            CHECK(std::isfinite(incident.diffuse.x));
            CHECK(agree(length(exact(incident.to_light)), 1, 1e-6));
        }
    }
}
