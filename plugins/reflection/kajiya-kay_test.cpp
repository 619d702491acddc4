#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <numbers>

#include "support/highlight.h"
#include "support/plugins.h"
#include "support/samples.h"

using candela::ReflectionModel;
using candela::Vec3;

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr Double3 k_up{0, 1, 0};

std::unique_ptr<ReflectionModel> hair(double shininess, const std::string& strand = "u") {
    return instance<ReflectionModel>(
        "kajiya-kay", {{"kd", 0.6}, {"ks", 0.4}, {"shininess", shininess}, {"strand", strand}});
}

/// The light that a white surface facing +y reflects.
ReflectedPair seen(const ReflectionModel& model, Double3 v, Double3 l) {
    const auto rounded = [](Double3 d) {
        return Vec3{static_cast<float>(d.x), static_cast<float>(d.y), static_cast<float>(d.z)};
    };
    return reflect(model, {{{0, 1, 0}, rounded(v), rounded(l), {1, 1, 1}, {1, 1, 1}}}, {1, 1, 1})[0];
}

/// The normals around a strand along the tangent of the surface facing +y.
Double3 normal_of_strand(double phi) {
    const Double3 t = tangent_at(k_up);
    return std::cos(phi) * k_up + std::sin(phi) * cross(k_up, t);
}

}  // namespace

TEST_CASE("reflection/kajiya-kay is the paper's function of the angles from the strand, along u or across") {
    for (const std::string strand : {"u", "v"}) {
        for (const double p : {1.0, 12.0, 80.0}) {
            INFO("strand " << strand << ", p " << p);
            check_reflection(
                *hair(p, strand),
                [&](Double3 n, Double3 v, Double3 l, Double3 color) -> ExactPair {
                    const Double3 u = tangent_at(n), t = strand == "u" ? u : cross(n, u);
                    const double to_light = std::acos(dot(t, l)), to_observer = std::acos(dot(t, v));
                    // The cone of mirror directions is at 180 degrees minus the light's angle.
                    const double s =
                        0.4 * std::pow(std::max(std::cos(to_observer - (k_pi - to_light)), 0.0), p);
                    return {0.6 * std::sin(to_light) * color, {s, s, s}};
                },
                1e-3);
        }
    }
}

TEST_CASE(
    "reflection/kajiya-kay is Lambert's light integrated around a thin cylinder, relative to its largest") {
    const auto model = hair(40);
    for (const Double3 l : {unit({0.2, 0.9, 0.3}), unit({0.8, 0.4, -0.5}), unit({-0.9, -0.3, 0.1})}) {
        constexpr int k_steps = 2000;
        double sum = 0;
        for (int i = 0; i < k_steps; ++i)
            sum += std::max(dot(normal_of_strand(2 * k_pi * i / k_steps), l), 0.0) * 2 * k_pi / k_steps;
        // Light across the strand: the integral of max(cos(phi), 0) is 2.
        CHECK(agree(static_cast<double>(seen(*model, k_up, l).diffuse.x), 0.6 * sum / 2, 1e-4));
    }
}

TEST_CASE("reflection/kajiya-kay is brightest in the mirror directions of every side of the strand") {
    const auto model = hair(200);
    const Double3 l = unit({0.5, 0.7, -0.4}), t = tangent_at(k_up);
    for (double phi = 0; phi < 2 * k_pi; phi += 0.4) {
        const Double3 n = normal_of_strand(phi), mirrored = 2 * dot(n, l) * n - l;
        INFO("phi " << phi);
        CHECK(agree(static_cast<double>(seen(*model, mirrored, l).specular.x), 0.4, 1e-4));
        // Ten degrees from the cone: cos(10 degrees)^200 = 0.0468.
        const double angle = std::acos(dot(t, mirrored)) + 10 * k_pi / 180;
        const Double3 off_cone =
            std::cos(angle) * t + std::sin(angle) * unit(mirrored - dot(t, mirrored) * t);
        CHECK(agree(static_cast<double>(seen(*model, off_cone, l).specular.x), 0.4 * 0.0468, 5e-3));
    }
}

TEST_CASE("reflection/kajiya-kay: the highlight of a rendered ball is a band across the strands") {
    const auto spread = [](const std::string& strand) {
        return highlight_aspect("kajiya-kay", "kd = 0, ka = 0, ks = 1, strand = \"" + strand + "\"");
    };
    CHECK(spread("u") < 0.3);
    CHECK(spread("v") > 3);
}
