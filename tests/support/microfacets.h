// Integrals over directions, to check the normalisation of distributions and reflection models.
#pragma once

#include <cmath>
#include <functional>
#include <numbers>
#include <vector>

#include "samples.h"

/// The integral of f over the hemisphere around +y, by the midpoint rule in polar angle and azimuth.
inline double over_hemisphere(const std::function<double(Double3)>& f, int steps = 400) {
    const double step = std::numbers::pi / 2 / steps;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double theta = (i + 0.5) * step;
        for (int j = 0; j < steps; ++j) {
            const double phi = 2 * std::numbers::pi * (j + 0.5) / steps;
            const Double3 d{std::sin(theta) * std::cos(phi), std::cos(theta),
                            std::sin(theta) * std::sin(phi)};
            sum += f(d) * std::sin(theta);
        }
    }
    return sum * step * 2 * std::numbers::pi / steps;
}

/// The fraction of uniform white light that a white surface facing +y reflects towards `to_observer`.
inline double directional_albedo(const candela::ReflectionModel& model, candela::Vec3 to_observer) {
    constexpr int k_steps = 200;
    std::vector<ReflectionSample> samples;
    over_hemisphere(
        [&](Double3 l) {
            samples.push_back({{0, 1, 0}, to_observer, rounded(l), {1, 1, 1}, {1, 1, 1}});
            return 0.0;
        },
        k_steps);
    const std::vector<ReflectedPair> reflected = reflect(model, samples, {1, 1, 1});
    std::size_t i = 0;
    const auto towards_observer = [&](Double3) {
        const ReflectedPair& r = reflected[i++];
        return double{r.diffuse.x} + double{r.specular.x};
    };
    return over_hemisphere(towards_observer, k_steps) / std::numbers::pi;
}

/// Fresnel's equations for the two polarisations (Born, Wolf 1999, 1.5.2 (21)), averaged: the fraction of
/// light mirrored by a surface between media of index 1 and `ior` >= 1.
inline double exact_fresnel(double cosine, double ior) {
    const double angle = std::acos(std::min(cosine, 1.0));
    if (angle < 1e-6) return std::pow((ior - 1) / (ior + 1), 2);
    const double refracted = std::asin(std::sin(angle) / ior);
    const double s = std::sin(angle - refracted) / std::sin(angle + refracted);
    const double p = std::tan(angle - refracted) / std::tan(angle + refracted);
    return (s * s + p * p) / 2;
}

/// The directions of a point, in polar coordinates around N, with azimuths from T.
struct Polar {
    double theta, phi;
};
inline Polar polar(Double3 n, Double3 t, Double3 d) {
    return {std::atan2(length(cross(n, d)), dot(n, d)), std::atan2(dot(d, cross(n, t)), dot(d, t))};
}

/// GGX with Smith's functions by slopes (Heitz 2014, eqs. 85 and 86, for different roughness along and across
/// T), over 4 N.L N.V.
inline double ggx(double alpha_t, double alpha_b, Polar h, Polar v, Polar l) {
    const auto squared = [](double x) { return x * x; };
    const double slope = squared(std::cos(h.phi) / alpha_t) + squared(std::sin(h.phi) / alpha_b);
    const double d = 1 / (std::numbers::pi * alpha_t * alpha_b * std::pow(std::cos(h.theta), 4) *
                          squared(1 + squared(std::tan(h.theta)) * slope));
    const auto lambda = [&](Polar p) {
        const double alpha2 = squared(alpha_t * std::cos(p.phi)) + squared(alpha_b * std::sin(p.phi));
        return (std::sqrt(1 + alpha2 * squared(std::tan(p.theta))) - 1) / 2;
    };
    return d / ((1 + lambda(v) + lambda(l)) * 4 * std::cos(v.theta) * std::cos(l.theta));
}

/// A point whose light is often near the mirror direction, as far from it as facets of that roughness send
/// it.
inline ReflectionSample random_sample(Random& random, double alpha) {
    for (;;) {
        const Double3 n = exact(random.direction()), v = exact(random.direction());
        Double3 l = exact(random.direction());
        if (random.number(0, 1) < 0.5) {
            const Double3 h = unit(unit(n) + random.number(0, 2) * alpha * l);
            l = 2 * dot(v, h) * h - v;
        }
        // Within a degree of the horizon, the last bits of directions decide.
        if (dot(unit(n), v) > 0.02 && dot(unit(n), unit(l)) > 0.02)
            return {rounded(unit(n)), rounded(v), rounded(unit(l)), {1, 1, 1}, {1, 1, 1}};
    }
}
