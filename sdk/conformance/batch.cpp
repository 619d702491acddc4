#include "batch.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <catch2/catch_test_macros.hpp>
#include <iterator>
#include <optional>
#include <utility>

import candela.api;

using candela::PluginKind;
using candela::Vec3;
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
BatchSubject reflection_subject(const Values& values, std::optional<candela::Rgb> color = std::nullopt,
                                std::vector<candela::VaryingParameter> varying = {}) {
    const std::shared_ptr<candela::ReflectionModel> model = make<candela::ReflectionModel>(values);
    const candela::SurfaceNeeds& needs = ::subject().surface_needs;
    const auto varied = std::make_shared<const std::vector<candela::VaryingParameter>>(std::move(varying));
    const auto surface = [needs, color, varied](std::size_t count, const Arrays& in) {
        return candela::SurfaceBatch{
            .count = count,
            .normal = in.vec3(k_normal),
            .to_observer = in.vec3(k_observer),
            .tangent = needs.tangent ? in.vec3(k_tangent) : candela::ConstVec3Span{},
            .color = color.value_or(candela::Rgb{0.8f, 0.5f, 0.2f}),
            .position = in.vec3(k_position),
            .uv = needs.uv ? candela::ConstVec2Span{in[k_uv], in[k_uv + 1]} : candela::ConstVec2Span{},
            .point_color = color ? candela::ConstVec3Span{} : in.vec3(k_color),
            .varying = *varied};
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

BatchSubject subject_of_varying(const Values& values, std::vector<candela::VaryingParameter> varying) {
    return reflection_subject(values, std::nullopt, std::move(varying));
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
