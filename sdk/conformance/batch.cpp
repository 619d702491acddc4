#include "batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <cmath>
#include <cstring>
#include <iterator>
#include <optional>
#include <random>
#include <span>

import candela.api;

using candela::PluginKind;
using candela::Vec3;

Arrays::Arrays(std::size_t arrays, std::size_t count, std::size_t shift)
    : count_(count), shift_(shift), data_(arrays, std::vector<float>(2 * k_guard + count + shift)) {
    for (std::vector<float>& array : data_) candela::fill_with_canary(array);
    fill(0);
}

void Arrays::fill(float value) {
    for (std::size_t a = 0; a < arrays(); ++a) std::fill_n((*this)[a], count_, value);
}

void Arrays::fill_with_canary() {
    for (std::size_t a = 0; a < arrays(); ++a) candela::fill_with_canary({(*this)[a], count_});
}

Arrays Arrays::fenced(Fence fence, const std::function<std::string(std::size_t)>& name) const {
    Arrays result(0, count_);
    for (std::size_t a = 0; a < arrays(); ++a) {
        result.fenced_.push_back(std::make_shared<Fenced>(name(a), count_ * sizeof(float), fence));
        std::copy_n((*this)[a], count_, result.fenced_.back()->as<float>());
    }
    return result;
}

Arrays Arrays::part(std::size_t first, std::size_t count, std::size_t shift) const {
    Arrays result(arrays(), count, shift);
    for (std::size_t a = 0; a < arrays(); ++a) std::copy_n((*this)[a] + first, count, result[a]);
    return result;
}

std::string Arrays::trespass() const {
    for (const std::span<const float> array : data_) {
        if (!candela::is_canary_intact(array.first(k_guard + shift_))) return "before";
        if (!candela::is_canary_intact(array.subspan(k_guard + shift_ + count_))) return "after";
    }
    return {};
}

bool operator==(const Arrays& a, const Arrays& b) {
    if (a.arrays() != b.arrays() || a.count() != b.count()) return false;
    for (std::size_t i = 0; i < a.arrays(); ++i) {
        if (std::memcmp(a[i], b[i], a.count() * sizeof(float)) != 0) return false;
    }
    return true;
}

using namespace inputs;

namespace {

/// Another colour in every direction, and an object of no particular shape: where a ray leaves it depends on
/// that ray alone.
class ColorfulEnvironment final : public candela::Environment {
  public:
    void look(std::size_t count, const candela::ConstVec3Span& towards,
              const candela::Vec3Span& intensity) override {
        for (std::size_t i = 0; i < count; ++i) intensity.set(i, Vec3{0.5f, 0.5f, 0.5f} + 0.5f * towards[i]);
    }
    float max_intensity() const noexcept override { return 1; }
    void trace_exit(std::size_t count, const candela::ConstVec3Span& origin,
                    const candela::ConstVec3Span& direction, const candela::ExitBatch& exit) override {
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = direction[i];
            exit.position.set(i, origin[i] + d);
            exit.normal.set(i, candela::normalized(d + 0.8f * Vec3{d.y, -d.z, d.x}));
            exit.distance[i] = d.x > 0.9f ? -1.0f : 1.0f;
        }
    }
};

/// Without `color`, each point has its own.
BatchSubject reflection_subject(const Values& values, std::optional<candela::Rgb> color = std::nullopt) {
    const std::shared_ptr<candela::ReflectionModel> model = make<candela::ReflectionModel>(values);
    const candela::SurfaceNeeds& needs = ::subject().surface_needs;
    const auto surface = [needs, color](std::size_t count, const Arrays& in) {
        return candela::SurfaceBatch{
            .count = count,
            .normal = in.vec3(k_normal),
            .to_observer = in.vec3(k_observer),
            .tangent = needs.tangent ? in.vec3(k_tangent) : candela::ConstVec3Span{},
            .color = color.value_or(candela::Rgb{0.8f, 0.5f, 0.2f}),
            .position = in.vec3(k_position),
            .uv = needs.uv ? candela::ConstVec2Span{in[k_uv], in[k_uv + 1]} : candela::ConstVec2Span{},
            .point_color = color ? candela::ConstVec3Span{} : in.vec3(k_color)};
    };
    const auto reflected = [](Arrays& out) {
        return candela::ReflectedBatch{
            .ambient = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)};
    };
    const std::vector<std::string> outputs{"ambient", "diffuse", "specular"};
    BatchSubject subject{
        model,
        k_inputs,
        {{"reflect", outputs, true, declares("may-be-negative"),
          [=](std::size_t count, const Arrays& in, Arrays& out) {
              model->reflect(surface(count, in),
                             {.to_light = in.vec3(k_light),
                              .diffuse = in.vec3(k_diffuse),
                              .specular = in.vec3(k_specular)},
                             reflected(out));
          }},
         {"reflect_ambient", outputs, true, false, [=](std::size_t count, const Arrays& in, Arrays& out) {
              model->reflect_ambient(surface(count, in), in.vec3(k_diffuse), reflected(out));
          }}}};
    // They keep the model, too.
    const std::shared_ptr<const candela::AllLightsReflection> all_lights(
        model, candela::extension_of<candela::AllLightsReflection>(*model));
    const std::shared_ptr<const candela::EnvironmentReflection> environment_reflection(
        model, candela::extension_of<candela::EnvironmentReflection>(*model));
    if (all_lights != nullptr && environment_reflection == nullptr) {
        subject.calls.push_back({"reflect_all_lights",
                                 {"intensity"},
                                 false,
                                 declares("may-be-negative"),
                                 [=](std::size_t count, const Arrays& in, Arrays& out) {
                                     candela::SurfaceBatch points = surface(count, in);
                                     points.to_observer = {};
                                     all_lights->reflect_all_lights(points, punctual_lighting(), out.vec3(0));
                                 }});
    }
    if (environment_reflection != nullptr) {
        subject.calls.push_back(
            {"show_environment", outputs, true, false, [=](std::size_t count, const Arrays& in, Arrays& out) {
                 ColorfulEnvironment environment;
                 environment_reflection->show_environment(surface(count, in), environment, reflected(out));
             }});
    }
    return subject;
}

BatchSubject light_subject(const Values& values) {
    const std::shared_ptr<candela::Light> light = make<candela::Light>(values);
    BatchSubject subject{light, k_inputs, {}};
    // Of thousands of samples, a few from all over are enough.
    constexpr int k_most_samples = 8;
    const int step = std::max(1, light->sample_count() / k_most_samples);
    for (int sample = 0; sample < light->sample_count(); sample += step) {
        subject.calls.push_back(
            {fmt::format("illuminate (sample {})", sample),
             {"to_light", "diffuse", "specular"},
             false,
             false,
             [=](std::size_t count, const Arrays& in, Arrays& out) {
                 light->illuminate(
                     sample, {.count = count, .position = in.vec3(k_position), .normal = in.vec3(k_normal)},
                     {.to_light = out.vec3(0), .diffuse = out.vec3(3), .specular = out.vec3(6)});
             }});
    }
    if (::subject().has_ambient) {
        subject.calls.push_back(
            {"illuminate_ambient",
             {"ambient"},
             false,
             false,
             [=](std::size_t count, const Arrays& in, Arrays& out) {
                 light->illuminate_ambient(
                     {.count = count, .position = in.vec3(k_position), .normal = in.vec3(k_normal)},
                     out.vec3(0));
             }});
    }
    return subject;
}

BatchSubject shading_subject(const Values& values) {
    const std::shared_ptr<candela::ShadingModel> model = make<candela::ShadingModel>(values);
    return {model,
            k_inputs,
            {{"normals", {"normal"}, false, true, [=](std::size_t count, const Arrays& in, Arrays& out) {
                  const candela::ShadingNeeds& needs = ::subject().shading_needs;
                  const auto given = [](bool is_needed, const candela::ConstVec3Span& span) {
                      return is_needed ? span : candela::ConstVec3Span{};
                  };
                  const bool has_triangle =
                      needs.triangle && model->shading_rate() != candela::ShadingRate::vertex;
                  candela::TriangleBatch triangle;
                  for (std::size_t k = 0; k < 3; ++k) {
                      triangle.position[k] = in.vec3(k_corner_positions + 3 * k);
                      triangle.normal[k] = in.vec3(k_corner_normals + 3 * k);
                  }
                  model->normals({.count = count,
                                  .face_normal = given(needs.face_normal, in.vec3(k_normal)),
                                  .vertex_normal = given(needs.vertex_normal, in.vec3(k_vertex_normal)),
                                  .barycentric = given(needs.barycentric, in.vec3(k_barycentric)),
                                  .uv = needs.uv ? candela::ConstVec2Span{in[k_uv], in[k_uv + 1]}
                                                 : candela::ConstVec2Span{},
                                  .dpdu = given(needs.derivatives, in.vec3(k_dpdu)),
                                  .dpdv = given(needs.derivatives, in.vec3(k_dpdv)),
                                  .triangle = has_triangle ? &triangle : nullptr},
                                 out.vec3(0));
              }}}};
}

}  // namespace

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

BatchSubject batch_subject(const Values& values) {
    switch (subject_manifest().kind) {
        case PluginKind::reflection:
            return reflection_subject(values);
        case PluginKind::light:
            return light_subject(values);
        default:
            return shading_subject(values);
    }
}

BatchSubject subject_of_one_color(const Values& values, candela::Rgb color) {
    return reflection_subject(values, color);
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
        const Vec3 axes[] = {{0, 1, 0}, {1, 0, 0}, {0, 0, 1}, {0.6f, 0.8f, 0}, {0, 0.8f, -0.6f}};
        in.vec3(k_observer).set(i, axes[i % 5]);
        in.vec3(k_light).set(i, axes[i / 5 % 5]);
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

Arrays outputs_of(const Call& call, const Arrays& in, std::size_t shift) {
    Arrays out(3 * call.outputs.size(), in.count(), shift);
    if (!call.adds) out.fill_with_canary();
    call.run(in.count(), in, out);
    return out;
}

std::string name_of_input(const Call& call, std::size_t array) {
    struct Input {
        std::size_t first;
        const char* name;
    };
    static constexpr std::array<Input, 19> k_names{{{k_normal, "normal"},
                                                    {k_observer, "to_observer"},
                                                    {k_tangent, "tangent"},
                                                    {k_light, "to_light"},
                                                    {k_diffuse, "diffuse"},
                                                    {k_specular, "specular"},
                                                    {k_position, "position"},
                                                    {k_barycentric, "barycentric"},
                                                    {k_vertex_normal, "vertex_normal"},
                                                    {k_dpdu, "dpdu"},
                                                    {k_dpdv, "dpdv"},
                                                    {k_uv, "uv"},
                                                    {k_corner_positions, "triangle->position[0]"},
                                                    {k_corner_positions + 3, "triangle->position[1]"},
                                                    {k_corner_positions + 6, "triangle->position[2]"},
                                                    {k_corner_normals, "triangle->normal[0]"},
                                                    {k_corner_normals + 3, "triangle->normal[1]"},
                                                    {k_corner_normals + 6, "triangle->normal[2]"},
                                                    {k_color, "point_color"}}};
    const auto input = std::prev(std::ranges::upper_bound(k_names, array, {}, &Input::first));
    std::string name = input->name;
    if (input->first == k_normal && call.name == "normals") name = "face_normal";
    if (input->first == k_diffuse && call.name == "reflect_ambient") name = "ambient";
    return fmt::format("{}.{}", name, "xyz"[array - input->first]);
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
