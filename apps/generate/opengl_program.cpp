// C++ with OpenGL: a template, the shaders as text, and the scene as uniform variables and arrays.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <vector>

#include "arrays.h"
#include "glsl_program.h"
#include "literals.h"
#include "target.h"

import candela.core;

namespace generate {

namespace {

using candela::ParamSet;
using candela::ParamType;
using candela::ParamValue;
using candela::Vec3;

/// A raw string literal, whose end is nowhere in the text.
std::string raw(const std::string& text) {
    std::string mark = "glsl";
    while (text.find(")" + mark + "\"") != std::string::npos) mark += "_";
    return fmt::format("R\"{0}({1}){0}\"", mark, text);
}

std::string braces(Vec3 v) {
    return fmt::format("{{{}, {}, {}}}", float_text(v.x), float_text(v.y), float_text(v.z));
}
std::string braces(candela::Rgb c) { return braces(Vec3{c.r, c.g, c.b}); }

class OpenGlWriter {
  public:
    OpenGlWriter(const ExportedScene& scene, const Templates& templates, candela::Registry& registry)
        : scene_(scene),
          templates_(templates),
          registry_(registry),
          encoding_(scene.image.color_management) {}

    std::vector<GeneratedFile> run() {
        std::string objects;
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) objects += object_text(i);
        const GlslParts glsl = glsl_of(scene_, templates_);
        const candela::ImageSettings& image = scene_.image;
        const Values about = {{"TITLE", tame(scene_.title)}, {"VERSION", CANDELA_VERSION}};
        Values values = {{"PRELUDE", raw(glsl.prelude)},
                         {"LIGHTS", raw(glsl.lights)},
                         {"VERTEX", raw(glsl.vertex)},
                         {"FRAGMENT", raw(glsl.fragment)},
                         {"SCREEN", raw(glsl.screen)},
                         {"ACCUMULATE", raw(glsl.accumulate)},
                         {"ENCODE", raw(glsl.encode)},
                         {"SHADINGS", models(scene_.shadings, glsl.shadings,
                                             [](const auto& m) { return rate_name(m.rate); })},
                         {"REFLECTIONS", models(scene_.reflections, glsl.reflections,
                                                [](const auto&) { return "fragment"; })},
                         {"WIDTH", fmt::format("{}", image.width)},
                         {"HEIGHT", fmt::format("{}", image.height)},
                         {"IS_SRGB", encoding_ == candela::ColorEncoding::srgb ? "true" : "false"},
                         {"BACKGROUND", braces(candela::decoded(image.background, encoding_))},
                         {"SAMPLES", samples()},
                         {"OBSERVER", observer()},
                         {"LIGHT_VALUES", light_values()},
                         {"OBJECTS", objects},
                         {"PICTURE_FILE", templates_.text("cpp/picture_file.h")}};
        values.insert(values.end(), about.begin(), about.end());
        return {{"scene.cpp", filled(templates_.text("opengl/scene.cpp"), values)},
                {"meshes.h", filled(templates_.text("opengl/meshes.h"),
                                    {{"VERSION", CANDELA_VERSION}, {"ARRAYS", arrays_}})},
                {"CMakeLists.txt", templates_.text("opengl/CMakeLists.txt")},
                {"README.md", filled(templates_.text("opengl/README.md"), about)}};
    }

  private:
    template <class Model, class RateOf>
    static std::string models(const std::vector<Model>& all, const std::vector<std::string>& glsl,
                              RateOf rate_of) {
        std::string text;
        for (std::size_t i = 0; i < all.size(); ++i)
            text +=
                fmt::format("    {{\"{}\", Rate::{}, {}}},\n", all[i].name(), rate_of(all[i]), raw(glsl[i]));
        return text;
    }

    std::string samples() const {
        std::vector<std::string> positions;
        for (const candela::SamplePosition& s : candela::sample_pattern(scene_.image.samples))
            positions.push_back(fmt::format("{{{}, {}}}", float_text(static_cast<float>(s.x) / 16),
                                            float_text(static_cast<float>(s.y) / 16)));
        return fmt::format("{{{}}}", fmt::join(positions, ", "));
    }

    std::string observer() const {
        const candela::Observer& o = scene_.observer;
        const bool is_perspective = o.projection == candela::Projection::perspective;
        return fmt::format("{}, {}, {}, {}, {}", braces(o.position), braces(o.look_at), braces(o.up),
                           is_perspective, float_text(is_perspective ? o.fov : o.height));
    }

    /// `prefix`: what stands before a member's name, "point_lights[0].".
    static std::string uniform(const std::string& prefix, const candela::Parameter& p,
                               const ParamValue& value) {
        switch (p.type) {
            case ParamType::real:
                return fmt::format("{{\"{}{}\", Uniform::real, {{{}, 0, 0}}}}", prefix, p.name,
                                   float_text(value.number[0]));
            case ParamType::integer:
            case ParamType::boolean:
            case ParamType::choice:
                return fmt::format("{{\"{}{}\", Uniform::whole, {{{}, 0, 0}}}}", prefix, p.name,
                                   value.integer);
            default:
                return fmt::format("{{\"{}{}\", Uniform::vector, {}}}", prefix, p.name,
                                   braces(Vec3{value.number[0], value.number[1], value.number[2]}));
        }
    }

    std::vector<std::string> uniforms(const std::string& prefix, const ParamSet& values) const {
        std::vector<std::string> all;
        const std::vector<ParamValue> delivered = values.delivered(encoding_);
        for (std::size_t i = 0; i < delivered.size(); ++i) {
            const candela::Parameter& p = values.schema()[i];
            if (p.type != ParamType::text && p.type != ParamType::file)
                all.push_back(uniform(prefix, p, delivered[i]));
        }
        return all;
    }

    std::string light_values() const {
        std::string text;
        const std::vector<LightUniform> names = light_uniforms(scene_);
        for (std::size_t i = 0; i < names.size(); ++i) {
            text += fmt::format("    // {}\n    {{\"{}\", Uniform::whole, {{1, 0, 0}}}},\n",
                                tame(scene_.lights[i].label), names[i].is_on);
            for (const std::string& one : uniforms(names[i].values + ".", scene_.lights[i].values))
                text += "    " + one + ",\n";
        }
        return text;
    }

    std::string all_uniforms(const std::vector<ParamSet>& sets) const {
        std::vector<std::string> all;
        for (const ParamSet& set : sets)
            all.push_back(fmt::format("{{{}}}", fmt::join(uniforms("", set), ", ")));
        return fmt::format("{{{}}}", fmt::join(all, ",\n      "));
    }

    std::string object_text(std::size_t index) {
        const ExportedObject& object = scene_.objects[index];
        add_arrays(index);
        return fmt::format("    {{\"{}\", {}, {}, {},\n     {},\n     {},\n     {}, object_{}()}},\n",
                           tame(object.label), braces(candela::decoded(object.color, encoding_)),
                           object.shading, object.reflection, all_uniforms(object.materials),
                           all_uniforms(object.shadings), object.closed, index);
    }

    void add_arrays(std::size_t index) {
        const WorldMesh world = world_mesh(scene_, scene_.objects[index], registry_);
        const candela::Mesh& mesh = world.mesh;
        std::string body = number_array("unsigned", "corners", mesh.indices) +
                           number_array("float", "position", interleaved(mesh.position));
        std::vector<std::string> sets;
        for (const candela::Vec3Arrays& normals : world.normals) {
            sets.push_back(fmt::format("normals_{}", sets.size()));
            body += number_array("float", sets.back().c_str(), interleaved(normals));
        }
        const auto optional = [&](const char* name, const std::vector<float>& numbers) {
            if (numbers.empty()) return "nullptr";
            body += number_array("float", name, numbers);
            return name;
        };
        const char* const uv =
            optional("uv", scene_.needs_uv() ? interleaved_uv(mesh) : std::vector<float>());
        const bool needs_derivatives = scene_.needs_derivatives();
        const char* const dpdu =
            optional("dpdu", needs_derivatives ? interleaved(mesh.dpdu) : std::vector<float>());
        const char* const dpdv =
            optional("dpdv", needs_derivatives ? interleaved(mesh.dpdv) : std::vector<float>());
        arrays_ += fmt::format(
            "\n// {}\ninline MeshArrays object_{}() {{\n{}    static const float* const normals[] = {{{}}};\n"
            "    static const std::size_t normals_of[] = {{{}}};\n    return {{{}, {}, corners, position, "
            "normals, normals_of, {}, {}, "
            "{}}};\n}}\n",
            tame(scene_.objects[index].label), index, body, fmt::join(sets, ", "),
            fmt::join(world.normals_of, ", "), mesh.vertex_count(), mesh.triangle_count(), uv, dpdu, dpdv);
    }

    const ExportedScene& scene_;
    const Templates& templates_;
    candela::Registry& registry_;
    candela::ColorEncoding encoding_;
    std::string arrays_;
};

}  // namespace

std::vector<GeneratedFile> opengl_program(const ExportedScene& scene, const Templates& templates,
                                          candela::Registry& registry) {
    return OpenGlWriter(scene, templates, registry).run();
}

}  // namespace generate
