// The page: a template, the scene as JSON, and the scripts that read it.
#include <fmt/format.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "arrays.h"
#include "glsl_program.h"
#include "literals.h"
#include "target.h"

import candela.core;

namespace generate {

namespace {

using Json = nlohmann::json;
using candela::Vec3;

Json vector_json(Vec3 v) { return {v.x, v.y, v.z}; }

Json limit_json(float limit) { return std::isfinite(limit) ? Json(limit) : Json(); }

Json parameter_json(const candela::Parameter& p) {
    return {{"name", p.name},
            {"type", candela::name_of(p.type)},
            {"unit", p.unit},
            {"meaning", p.meaning},
            {"default", p.default_value ? json_value(*p.default_value) : Json()},
            {"minimum", limit_json(p.minimum)},
            {"maximum", limit_json(p.maximum)},
            {"minimum_excluded", p.minimum_excluded},
            {"maximum_excluded", p.maximum_excluded},
            {"choices", p.choices}};
}

Json model_json(const ExportedModel& model, const std::string& glsl) {
    Json parameters = Json::array();
    for (const candela::Parameter& p : model.manifest->parameters) parameters.push_back(parameter_json(p));
    return {{"title", model.manifest->title},      {"summary", model.manifest->summary},
            {"formula", model.manifest->formula},  {"reference", model.manifest->reference},
            {"parameters", std::move(parameters)}, {"glsl", glsl}};
}

Json values_json(const candela::ParamSet& values) {
    Json result = Json::object();
    for (std::size_t i = 0; i < values.schema().size(); ++i) {
        if (values.get(i)) result[values.schema()[i].name] = json_value(*values.get(i));
    }
    return result;
}

template <class T, class Allocator>
std::string packed(const std::vector<T, Allocator>& values) {
    return base64(std::as_bytes(std::span(values)));
}

Json packed(const candela::Vec3Arrays& arrays) {
    return arrays.empty() ? Json() : Json(packed(interleaved(arrays)));
}

Json packed_uv(const candela::Mesh& mesh) {
    return mesh.u.empty() ? Json() : Json(packed(interleaved_uv(mesh)));
}

Json mesh_json(const ExportedScene& scene, const WorldMesh& world) {
    Json normals = Json::array(), normals_of = Json::object();
    for (const candela::Vec3Arrays& set : world.normals) normals.push_back(packed(set));
    for (std::size_t i = 0; i < scene.shadings.size(); ++i)
        normals_of[scene.shadings[i].name()] = world.normals_of[i];
    const candela::Mesh& mesh = world.mesh;
    return {{"vertices", mesh.vertex_count()},
            {"triangles", mesh.triangle_count()},
            {"indices", packed(mesh.indices)},
            {"position", packed(mesh.position)},
            {"normals", std::move(normals)},
            {"normals_of", std::move(normals_of)},
            {"uv", scene.needs_uv() ? packed_uv(mesh) : Json()},
            {"dpdu", scene.needs_derivatives() ? packed(mesh.dpdu) : Json()},
            {"dpdv", scene.needs_derivatives() ? packed(mesh.dpdv) : Json()}};
}

Json object_json(const ExportedScene& scene, const ExportedObject& object, candela::Registry& registry) {
    Json materials = Json::object(), shadings = Json::object();
    for (std::size_t i = 0; i < scene.reflections.size(); ++i)
        materials[scene.reflections[i].name()] = values_json(object.materials[i]);
    for (std::size_t i = 0; i < scene.shadings.size(); ++i)
        shadings[scene.shadings[i].name()] = values_json(object.shadings[i]);
    return {{"label", object.label},
            {"color", vector_json(object.color)},
            {"shading", scene.shadings[object.shading].name()},
            {"reflection", scene.reflections[object.reflection].name()},
            {"materials", std::move(materials)},
            {"shadings", std::move(shadings)},
            {"closed", object.closed},
            {"mesh", mesh_json(scene, world_mesh(scene, object, registry))}};
}

Json image_json(const candela::ImageSettings& image) {
    Json positions = Json::array();
    for (const candela::SamplePosition& s : candela::sample_pattern(image.samples))
        positions.push_back({s.x / 16.0, s.y / 16.0});
    return {{"width", image.width},
            {"height", image.height},
            {"samples", image.samples},
            {"sample_positions", std::move(positions)},
            {"background", vector_json(image.background)},
            {"color_management", image.color_management == candela::ColorEncoding::srgb ? "srgb" : "none"}};
}

Json observer_json(const candela::Observer& observer) {
    const bool is_perspective = observer.projection == candela::Projection::perspective;
    return {{"position", vector_json(observer.position)},
            {"look_at", vector_json(observer.look_at)},
            {"up", vector_json(observer.up)},
            {"projection", is_perspective ? "perspective" : "orthographic"},
            {"fov", observer.fov},
            {"height", observer.height}};
}

Json scene_json(const ExportedScene& scene, const Templates& templates, candela::Registry& registry) {
    const GlslParts glsl = glsl_of(scene, templates);
    Json lights = Json::array(), objects = Json::array();
    Json light_models = Json::object(), reflections = Json::object(), shadings = Json::object();
    const std::vector<LightUniform> uniforms = light_uniforms(scene);
    for (std::size_t i = 0; i < scene.lights.size(); ++i) {
        const ExportedLight& light = scene.lights[i];
        lights.push_back({{"label", light.label},
                          {"model", scene.light_models[light.model].name()},
                          {"uniform", uniforms[i].values},
                          {"switch", uniforms[i].is_on},
                          {"values", values_json(light.values)}});
    }
    for (const ExportedModel& model : scene.light_models)
        light_models[model.name()] = model_json(model, model.kernel.text());
    for (std::size_t i = 0; i < scene.reflections.size(); ++i)
        reflections[scene.reflections[i].name()] = model_json(scene.reflections[i], glsl.reflections[i]);
    for (std::size_t i = 0; i < scene.shadings.size(); ++i) {
        Json& model = shadings[scene.shadings[i].name()] = model_json(scene.shadings[i], glsl.shadings[i]);
        model["rate"] = rate_name(scene.shadings[i].rate);
    }
    for (const ExportedObject& object : scene.objects)
        objects.push_back(object_json(scene, object, registry));
    return {{"title", scene.title},
            {"candela", CANDELA_VERSION},
            {"image", image_json(scene.image)},
            {"observer", observer_json(scene.observer)},
            {"shaders",
             {{"prelude", glsl.prelude},
              {"lights", glsl.lights},
              {"vertex", glsl.vertex},
              {"fragment", glsl.fragment},
              {"screen", glsl.screen},
              {"accumulate", glsl.accumulate},
              {"encode", glsl.encode}}},
            {"lights", std::move(lights)},
            {"light_models", std::move(light_models)},
            {"reflection_models", std::move(reflections)},
            {"shading_models", std::move(shadings)},
            {"objects", std::move(objects)}};
}

}  // namespace

std::vector<GeneratedFile> webgl_page(const ExportedScene& scene, const Templates& templates,
                                      candela::Registry& registry) {
    return {{"scene.html", filled(templates.text("webgl/page.html"),
                                  {{"TITLE", html_text(scene.title)},
                                   {"STYLE", templates.text("webgl/page.css")},
                                   {"SCENE", script_json(scene_json(scene, templates, registry))},
                                   {"SCRIPT", templates.text("webgl/page.js")}})}};
}

}  // namespace generate
