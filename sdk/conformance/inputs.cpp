#include "inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <random>

#include "subject.h"

import candela.api;

using candela::PluginKind;
using candela::Vec3;
using namespace inputs;

const candela::PunctualLighting& punctual_lighting() {
    static const auto lights = [] {
        candela::PunctualLight lamp{.position = {2.5f, 3, 1}, .diffuse = {9, 8, 7}, .specular = {7, 8, 9}};
        lamp.constant = 0;
        lamp.quadratic = 1;
        const candela::PunctualLight sun{.position = {0.6f, 0, -0.8f},
                                         .w = 0,
                                         .diffuse = {0.3f, 0.2f, 0.1f},
                                         .specular = {0.1f, 0.2f, 0.3f}};
        candela::PunctualLight spot{.position = {-3, 1, 2}, .diffuse = {2, 2, 3}, .specular = {3, 2, 2}};
        spot.linear = 0.5f;
        spot.has_cone = spot.is_smooth = true;
        spot.axis = candela::normalized({3, -1, -2});
        spot.cos_outer = 0.7f;
        spot.cone_scale = 5;
        return std::array<candela::PunctualLight, 3>{lamp, sun, spot};
    }();
    static const Fenced fenced("lights", sizeof lights, Fence::after);
    std::ranges::copy(lights, fenced.as<candela::PunctualLight>());
    static const candela::PunctualLighting lighting{
        .observer = {0.5f, 1, 6},
        .ambient = {0.1f, 0.2f, 0.3f},
        .lights = {fenced.as<candela::PunctualLight>(), lights.size()}};
    return lighting;
}

void put_triangle(Arrays& in, std::size_t i, const std::array<Vec3, 3>& normals) {
    const Vec3 n = in.at(k_normal, i), t = in.at(k_tangent, i), weight = in.at(k_barycentric, i);
    const Vec3 aside = cross(n, t);
    const std::array<Vec3, 3> corner{1.5f * t, -0.5f * t + 0.75f * aside, -0.75f * t - 0.5f * aside};
    const Vec3 place = weight.x * corner[0] + weight.y * corner[1] + weight.z * corner[2];
    for (std::size_t k = 0; k < 3; ++k) {
        in.vec3(k_corner_positions + 3 * k).set(i, in.at(k_position, i) + corner[k] - place);
        in.vec3(k_corner_normals + 3 * k).set(i, normals[k]);
    }
}

Arrays inputs_for(std::size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::normal_distribution<float> normal;
    std::uniform_real_distribution<float> unit(0, 1);
    const auto direction = [&] {
        return candela::normalized({normal(random), normal(random), normal(random)});
    };
    // Their own random numbers, so that all other inputs are the same as without triangles.
    std::mt19937 random_corner(seed + 1000);
    std::normal_distribution<float> normal_corner;
    const auto bent = [&](Vec3 n) {
        const float x = normal_corner(random_corner), y = normal_corner(random_corner),
                    z = normal_corner(random_corner);
        return candela::normalized(n + 0.3f * candela::normalized({x, y, z}));
    };
    std::mt19937 random_color(seed + 2000);  // also separate
    Arrays in(k_inputs, count);
    for (std::size_t i = 0; i < count; ++i) {
        const Vec3 n = direction();
        Vec3 v = direction();
        if (dot(n, v) < 0) v = -v;
        const Vec3 aside = direction();
        in.vec3(k_normal).set(i, n);
        in.vec3(k_observer).set(i, v);
        in.vec3(k_tangent).set(i, candela::normalized(aside - dot(n, aside) * n));
        in.vec3(k_light).set(i, direction());
        in.vec3(k_diffuse).set(i, {unit(random), unit(random), unit(random)});
        in.vec3(k_specular).set(i, {unit(random), unit(random), unit(random)});
        in.vec3(k_position)
            .set(i, 4.0f * Vec3{unit(random) - 0.5f, unit(random) - 0.5f, unit(random) - 0.5f});
        const float a = unit(random), b = (1 - a) * unit(random);
        in.vec3(k_barycentric).set(i, {a, b, 1 - a - b});
        in.vec3(k_vertex_normal).set(i, n + 0.3f * direction());
        const Vec3 du = in.vec3(k_tangent)[i];
        in.vec3(k_dpdu).set(i, 2.0f * du);
        in.vec3(k_dpdv).set(i, 0.5f * cross(n, du) + 0.1f * du);
        in[k_uv][i] = unit(random);
        in[k_uv + 1][i] = unit(random);
        in.vec3(k_color).set(i, {unit(random_color), unit(random_color), unit(random_color)});
        const Vec3 n0 = bent(n), n1 = bent(n), n2 = bent(n);
        put_triangle(in, i, {n0, n1, n2});
    }
    return in;
}

Arrays aligned_inputs() {
    constexpr std::size_t k_cases = 16;
    Arrays in = inputs_for(8 * k_cases, 11);
    for (std::size_t i = 0; i < in.count(); ++i) {
        const Vec3 n = in.at(k_normal, i), t = in.at(k_tangent, i), v = in.at(k_observer, i);
        const Vec3 mirrored = candela::normalized(2 * dot(n, v) * n - v);
        // Half of them have normals along an axis, where products are exact.
        const Vec3 views[] = {v, n, v, v, v, n, n, t, t, v, -t, t, v, n, v, t};
        const Vec3 lights[] = {v, v, n, mirrored, -v, n, -n, n, t, -n, t, -t, t, t, -mirrored, v};
        in.vec3(k_observer).set(i, views[i % k_cases]);
        in.vec3(k_light).set(i, lights[i % k_cases]);
        in.vec3(k_vertex_normal).set(i, (i % 2 == 0 ? 1.0f : 0.5f) * n);
        put_triangle(in, i, {n, n, n});
        if (i < in.count() / 2) continue;
        in.vec3(k_normal).set(i, {0, 1, 0});
        in.vec3(k_tangent).set(i, {1, 0, 0});
        in.vec3(k_vertex_normal).set(i, {0, 1, 0});
        in.vec3(k_barycentric)
            .set(i, {i % 3 == 0 ? 1.0f : 0.0f, i % 3 == 1 ? 1.0f : 0.0f, i % 3 == 2 ? 1.0f : 0.0f});
        const Vec3 axes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0.6f, 0.8f, 0}, {0, 0.8f, -0.6f}, {0, -1, 0}};
        in.vec3(k_observer).set(i, axes[i % 5]);
        in.vec3(k_light).set(i, axes[i / 5 % 6]);
        in.vec3(k_dpdu).set(i, {2, 0, 0});
        in.vec3(k_dpdv).set(i, {0, 0, -2});
        const Vec3 up{0, 1, 0};
        put_triangle(in, i, {up, up, up});
    }
    return in;
}

Vec3 turned(Vec3 p) {
    // By 0.6435 rad about z (3-4-5), then about x.
    const Vec3 q{0.8f * p.x - 0.6f * p.y, 0.6f * p.x + 0.8f * p.y, p.z};
    return {q.x, 0.28f * q.y - 0.96f * q.z, 0.96f * q.y + 0.28f * q.z};
}

Arrays turned(const Arrays& in) {
    Arrays result = in;
    for (const std::size_t vector :
         {k_normal, k_observer, k_tangent, k_light, k_vertex_normal, k_dpdu, k_dpdv, k_corner_positions,
          k_corner_positions + 3, k_corner_positions + 6, k_corner_normals, k_corner_normals + 3,
          k_corner_normals + 6}) {
        for (std::size_t i = 0; i < in.count(); ++i) result.vec3(vector).set(i, turned(in.at(vector, i)));
    }
    return result;
}

std::string text_of_input(const Arrays& in, std::size_t i) {
    const auto text = [&](const char* name, std::size_t first) {
        const Vec3 v = in.at(first, i);
        return fmt::format("{} = [{:.4g}, {:.4g}, {:.4g}]", name, v.x, v.y, v.z);
    };
    switch (subject_manifest().kind) {
        case PluginKind::reflection:
            return fmt::format("{}, {}, {}", text("N", k_normal), text("V", k_observer), text("L", k_light));
        case PluginKind::light:
            return fmt::format("{}, {}", text("position", k_position), text("N", k_normal));
        default:
            return fmt::format("{}, {}", text("face normal", k_normal),
                               text("vertex normal", k_vertex_normal));
    }
}
