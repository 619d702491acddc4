// The page: a template, the scene as JSON, and the scripts that read it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <nlohmann/json.hpp>
#include <numbers>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "candela/embed.h"
#include "candela/target/arrays.h"
#include "candela/target/files.h"
#include "candela/target/glsl.h"
#include "candela/target/literals.h"
#include "candela/target/mirror.h"
#include "candela/target/page_arrays.h"
#include "candela/target/page_image.h"
#include "candela/target/text_template.h"
#include "candela/target/textures.h"
#include "candela/target_plugin.h"
#include "page_json.h"

CANDELA_EMBED(candela_webgl_page, CANDELA_SOURCE_DIR "/templates/page.html");
CANDELA_EMBED(candela_webgl_style, CANDELA_WEB "/page.css");
CANDELA_EMBED(candela_webgl_editor_style, CANDELA_WEB "/editor.css");
CANDELA_EMBED(candela_webgl_lobe, CANDELA_SOURCE_DIR "/templates/lobe.glsl");
CANDELA_EMBED(candela_webgl_codemirror, CANDELA_PAGE_CODEMIRROR);
CANDELA_EMBED(candela_webgl_script, CANDELA_PAGE_SCRIPT);

namespace candela::webgl_target {

using namespace target;

namespace {

using Json = nlohmann::json;

Json vector_json(Vec3 v) { return {v.x, v.y, v.z}; }

Json limit_json(float limit) { return std::isfinite(limit) ? Json(limit) : Json(); }

/// A value as written in a scene file.
Json value_json(const ParamSpec& p, const ParamValue& written) {
    switch (p.type) {
        case ParamType::real:
            return shortest(written.number[0]);
        case ParamType::integer:
            return written.integer;
        case ParamType::boolean:
            return written.integer != 0;
        case ParamType::choice:
            return p.choices[static_cast<std::size_t>(written.integer)];
        default:
            return {shortest(written.number[0]), shortest(written.number[1]), shortest(written.number[2])};
    }
}

/// Whether the page has a control for it; otherwise it keeps the scene's value.
bool is_adjustable(const ParamSpec& p) {
    return p.type != ParamType::text && p.type != ParamType::file && p.type != ParamType::matrix &&
           p.type != ParamType::numbers;
}

/// A value in the form for shaders.
Json uniform_json(const ParamSpec& p, const ParamValue& value) {
    if (p.type == ParamType::real) return {{"kind", "float"}, {"value", value.number[0]}};
    if (p.type == ParamType::integer || p.type == ParamType::boolean || p.type == ParamType::choice)
        return {{"kind", "int"}, {"value", value.integer}};
    return {{"kind", "vec3"}, {"value", {value.number[0], value.number[1], value.number[2]}}};
}

/// The values that kernels read and the page cannot change: { name: { kind, value } }, in the form for
/// shaders. `are_all_fixed`: those that it usually can, too.
Json fixed_json(const ExportedModel& model, const ExportedValues& values, bool are_all_fixed = false) {
    Json result = Json::object();
    for (const std::size_t i : model.plugin->kernel.members) {
        const ParamSpec& p = model.plugin->parameters[i];
        const ParamValue& value = values.runtime[i];
        if (is_adjustable(p)) {
            if (are_all_fixed) result[p.name] = uniform_json(p, value);
            continue;
        }
        if (p.type == ParamType::matrix) {
            Json columns = Json::array();
            for (const Vec3& c : columns_of(value)) columns.insert(columns.end(), {c.x, c.y, c.z});
            result[p.name] = {{"kind", "mat3"}, {"value", std::move(columns)}};
        } else {
            result[p.name] = {{"kind", "table"}, {"value", {value.integer, value.list.size()}}};
        }
    }
    return result;
}

Json parameter_json(const ParamSpec& p) {
    Json choices = Json::array();
    for (const char* const choice : p.choices) choices.push_back(choice);
    return {{"name", p.name},
            {"type", name_of(p.type)},
            {"unit", p.unit},
            {"meaning", p.meaning},
            {"default", p.required ? Json() : value_json(p, p.default_value)},
            {"minimum", limit_json(p.minimum)},
            {"maximum", limit_json(p.maximum)},
            {"minimum_excluded", p.minimum_excluded},
            {"maximum_excluded", p.maximum_excluded},
            {"choices", std::move(choices)}};
}

/// Named sets of values: { name, source, values, color }.
Json preset_json(const PluginDescriptor& plugin, const PresetSpec& preset) {
    Json values = Json::object();
    for (const PresetValue& v : preset.values) {
        for (const ParamSpec& p : plugin.parameters) {
            if (std::string_view(p.name) == v.parameter && is_adjustable(p))
                values[p.name] = value_json(p, v.value);
        }
    }
    const bool has_color = preset.has_color;
    return {{"name", preset.name},
            {"source", preset.source},
            {"values", std::move(values)},
            {"color", has_color ? Json{preset.color[0], preset.color[1], preset.color[2]} : Json()}};
}

Json model_json(const ExportedModel& model, const std::string& glsl) {
    const PluginDescriptor& plugin = *model.plugin;
    Json parameters = Json::array();
    for (const ParamSpec& p : plugin.parameters) {
        if (is_adjustable(p)) parameters.push_back(parameter_json(p));
    }
    Json presets = Json::array();
    for (const PresetSpec& preset : plugin.presets) presets.push_back(preset_json(plugin, preset));
    return {{"id", model.id},
            {"title", plugin.title},
            {"summary", plugin.summary},
            {"formula", plugin.formula},
            {"reference", plugin.reference},
            {"parameters", std::move(parameters)},
            {"presets", std::move(presets)},
            {"kernel", plugin.kernel.text},
            {"glsl", glsl}};
}

/// The places of a light model's lights in the table that shaders read.
Json block_json(const ExportedModel& model, const LightBlock& block) {
    Json members = Json::array();
    for (const std::size_t i : model.plugin->kernel.members)
        members.push_back(model.plugin->parameters[i].name);
    return {{"count", block.count},
            {"lights", block.lights},
            {"first", block.first},
            {"texels", block.size},
            {"members", std::move(members)}};
}

Json values_json(const ExportedModel& model, const ExportedValues& values) {
    Json result = Json::object();
    for (std::size_t i = 0; i < values.written.size(); ++i) {
        const ParamSpec& p = model.plugin->parameters[i];
        if (is_adjustable(p)) result[p.name] = value_json(p, values.written[i]);
    }
    return result;
}

Json mesh_json(const ExportedScene& scene, const ExportedMesh& mesh, PageArrays& arrays) {
    const std::size_t count = mesh.vertex_count;
    const auto put = [&](const auto& vectors) {
        return vectors ? Json(arrays.put(std::as_bytes(std::span<const float>(interleaved(vectors, count)))))
                       : Json();
    };
    Json normals = Json::array(), normals_of = Json::object();
    for (const ConstVec3Span& set : mesh.normals) normals.push_back(put(set));
    for (std::size_t i = 0; i < scene.shadings.size(); ++i)
        normals_of[scene.shadings[i].plugin->name] = mesh.normals_of[i];
    return {{"vertices", count},
            {"triangles", mesh.triangle_count()},
            {"indices", arrays.put(std::as_bytes(mesh.indices))},
            {"position", put(mesh.position)},
            {"normals", std::move(normals)},
            {"normals_of", std::move(normals_of)},
            {"uv", scene.needs_uv ? put(mesh.uv) : Json()},
            {"dpdu", scene.needs_derivatives ? put(mesh.dpdu) : Json()},
            {"dpdv", scene.needs_derivatives ? put(mesh.dpdv) : Json()},
            {"color", put(mesh.color)},
            {"channels", arrays.put(mesh.channels)},
            {"has_second_uv", static_cast<bool>(mesh.second_uv)}};
}

/// The names of the parameters of its own reflection model that pictures or vertices give.
Json textured_json(const ExportedScene& scene, const ExportedObject& object) {
    Json names = Json::array();
    for (const ExportedTexturedNumber& number : object.textured_numbers) {
        const char* const name =
            scene.reflections[object.reflection].plugin->parameters[number.parameter].name;
        if (std::ranges::find(names, Json(name)) == names.end()) names.push_back(name);
    }
    return names;
}

Json object_json(const ExportedScene& scene, std::size_t index, PageArrays& arrays) {
    const ExportedObject& object = scene.objects[index];
    Json materials = Json::object(), shadings = Json::object();
    Json fixed_materials = Json::object(), fixed_shadings = Json::object();
    for (std::size_t i = 0; i < scene.reflections.size(); ++i) {
        const ExportedReflection& model = scene.reflections[i];
        materials[model.plugin->name] = values_json(model, object.materials[i]);
        fixed_materials[model.plugin->name] = fixed_json(model, object.materials[i]);
    }
    for (std::size_t i = 0; i < scene.shadings.size(); ++i) {
        const ExportedShading& model = scene.shadings[i];
        shadings[model.plugin->name] = values_json(model, object.shadings[i]);
        fixed_shadings[model.plugin->name] = fixed_json(model, object.shadings[i]);
    }
    const ExportedMesh mesh = scene.geometry->in_world_space(index);
    Json json = {
        {"label", object.label},
        {"color", vector_json(object.color)},
        {"shading", scene.shadings[object.shading].plugin->name},
        {"reflection", scene.reflections[object.reflection].plugin->name},
        {"materials", std::move(materials)},
        {"shadings", std::move(shadings)},
        {"fixed", {{"material", std::move(fixed_materials)}, {"shading", std::move(fixed_shadings)}}},
        {"closed", mesh.closed},
        {"is_color_textured", !object.color_numbers.empty()},
        {"textured", textured_json(scene, object)},
        {"material", all_textured_numbers(object).empty() ? Json() : Json(index)},
        {"common_material", has_common_textures(object) ? Json(scene.objects.size() + index) : Json()},
        {"normal_map", object.normal_map == nullptr ? Json() : Json(index)},
        {"material_pictures", pictures_json(object)},
        {"mesh", mesh_json(scene, mesh, arrays)}};
    const Rgb emission = emission_of(object, scene.image.color_management);
    if (has_emission(scene)) json["emission"] = {emission.r, emission.g, emission.b};
    if (emission != Rgb{}) json["emission_strength"] = shortest(object.emission_strength);
    if (object.normal_map != nullptr)
        json["normal_scale"] = {
            {"path", object.normal_map->has_slopes ? "bump_map.height" : "normal_map.scale"},
            {"value", shortest(object.normal_map->scale)}};
    if (has_occlusion(scene)) json["occlusion"] = object.occlusion;
    put_opacity(json, scene, index);
    if (scene.has_shadows) {
        json["receives_shadows"] = object.receives_shadows;
        json["is_solid"] = mesh.is_solid;
        const Vec3 middle = middle_of(mesh);
        json["middle"] = {middle.x, middle.y, middle.z};
    }
    return json;
}

Json textures_json(const ExportedScene& scene, PageArrays& arrays) {
    Json textures = Json::array();
    for (const PageTexture& texture : put_textures(scene, arrays)) {
        textures.push_back({{"title", texture.title},
                            {"width", texture.width},
                            {"height", texture.height},
                            {"encoded", texture.is_encoded},
                            {"pixels", texture.pixels}});
    }
    return textures;
}

/// The values of the parameter "tone" of the page's scripts, and of scenes.
constexpr std::array<const char*, 5> k_tones = {"none", "khronos-neutral", "aces", "agx", "reinhard"};

/// The exposure value at ISO 100 whose factor is the image's, with the digits that identify it.
Json exposure_value(const ExportedImage& image) {
    return std::round(1e6 * -std::log2(1.2 * static_cast<double>(image.exposure))) / 1e6;
}

Json image_json(const ExportedImage& image) {
    Json positions = Json::array();
    for (const ExportedSample& s : image.samples) positions.push_back({s.x, s.y});
    return {{"width", image.width},
            {"height", image.height},
            {"samples", image.samples.size()},
            {"sample_positions", std::move(positions)},
            {"background", vector_json(image.background)},
            {"exposure", exposure_value(image)},
            {"exposure_factor", image.exposure},
            {"tone", k_tones.at(static_cast<std::size_t>(image.tone))},
            {"color_management", image.color_management == ColorEncoding::srgb ? "srgb" : "none"}};
}

/// The factor by which the picture is higher than its own angle or height, so that the scene's frame fits in.
double widening(const ExportedObserver& observer) {
    if (observer.projection == Projection::orthographic)
        return observer.height == observer.unfitted_height
                   ? 1
                   : double{observer.height} / double{observer.unfitted_height};
    const auto height = [](double degrees) { return std::tan(degrees * std::numbers::pi / 360); };
    return observer.fov == observer.unfitted_fov ? 1 : height(observer.fov) / height(observer.unfitted_fov);
}

Json observer_json(const ExportedObserver& observer) {
    const bool is_perspective = observer.projection == Projection::perspective;
    return {{"position", vector_json(observer.position)},
            {"look_at", vector_json(observer.look_at)},
            {"up", vector_json(observer.up)},
            {"projection", is_perspective ? "perspective" : "orthographic"},
            {"fov", observer.unfitted_fov},
            {"height", observer.unfitted_height},
            {"widening", widening(observer)}};
}

/// Adds the arrays that it names to the page.
Json scene_json(const ExportedScene& scene, PageArrays& arrays) {
    const GlslParts glsl = glsl_of(scene, k_reversed_depth, NormalScale::uniform);
    std::vector<std::string> materials = glsl.materials;
    materials.insert(materials.end(), glsl.common_materials.begin(), glsl.common_materials.end());
    Json lights = Json::array(), objects = Json::array();
    Json light_models = Json::object(), reflections = Json::object(), shadings = Json::object();
    for (const ExportedLight& light : scene.lights) {
        const ExportedModel& model = scene.light_models[light.model];
        // Its mirror image does not follow.
        const bool is_kept = is_mirrored(scene, light.model);
        lights.push_back({{"label", light.label},
                          {"model", model.plugin->name},
                          {"values", is_kept ? Json::object() : values_json(model, light.values)},
                          {"fixed", fixed_json(model, light.values, is_kept)}});
        if (has_mirror_images(scene))
            lights.back()["radiance"] = vector_json(radiance_place(scene, lights.size() - 1));
        if (scene.has_shadows) lights.back()["shadows"] = vector_json(shadow_texel(light));
    }
    const std::vector<LightBlock> blocks = light_blocks(scene);
    for (std::size_t i = 0; i < blocks.size(); ++i) {
        const ExportedModel& model = scene.light_models[i];
        Json& json = light_models[model.plugin->name] = model_json(model, model.plugin->kernel.text);
        json["block"] = block_json(model, blocks[i]);
        if (is_mirrored(scene, i)) json["parameters"] = Json::array();
    }
    for (std::size_t i = 0; i < scene.reflections.size(); ++i) {
        Json& json = reflections[scene.reflections[i].plugin->name] =
            model_json(scene.reflections[i], glsl.reflections[i]);
        json["needs_tangent"] = scene.reflections[i].needs.tangent;
        json["needs_uv"] = scene.reflections[i].needs.uv;
    }
    for (std::size_t i = 0; i < scene.shadings.size(); ++i) {
        Json& model = shadings[scene.shadings[i].plugin->name] =
            model_json(scene.shadings[i], glsl.shadings[i]);
        model["rate"] = rate_name(scene.shadings[i].rate);
        model["sees_triangle"] = scene.shadings[i].needs.triangle;
    }
    for (std::size_t i = 0; i < scene.objects.size(); ++i) objects.push_back(object_json(scene, i, arrays));
    const std::string tables = arrays.put(std::as_bytes(scene.tables));
    Json textures = textures_json(scene, arrays);
    Json json = {{"title", scene.title},
                 {"candela", CANDELA_PLUGIN_VERSION},
                 {"image", image_json(scene.image)},
                 {"observer", observer_json(scene.observer)},
                 {"room", vector_json(scene.room)},
                 {"shaders",
                  {{"prelude", glsl.prelude},
                   {"library", whole_glsl_prelude()},
                   {"texture", glsl.texture},
                   {"materials", materials},
                   {"normal_maps", glsl.normal_maps},
                   {"opacities", glsl.opacities},
                   {"lights", glsl.lights},
                   {"vertex", glsl.vertex},
                   {"fragment", glsl.fragment},
                   {"screen", glsl.screen},
                   {"accumulate", glsl.accumulate},
                   {"encode", glsl.encode},
                   {"lobe", std::string(candela_webgl_lobe)}}},
                 {"light_table_width", k_light_table_width},
                 {"tables", tables},
                 {"table_width", k_table_width},
                 {"textures", std::move(textures)},
                 {"lights", std::move(lights)},
                 {"light_models", std::move(light_models)},
                 {"reflection_models", std::move(reflections)},
                 {"shading_models", std::move(shadings)},
                 {"objects", std::move(objects)}};
    if (scene.has_shadows) json["shadows"] = shadows_json(scene, arrays);
    if (has_mirror_images(scene))
        json["radiance"] = {
            {"width", k_radiance_width},
            {"texels", arrays.put(std::as_bytes(std::span<const float>(radiance_texels(scene))))}};
    json["arrays"] = arrays.names();
    return json;
}

/// Invalid UTF-8 is replaced.
std::string text_of(const Json& json) { return json.dump(-1, ' ', false, Json::error_handler_t::replace); }

class WebGlTarget final : public Target {
  public:
    explicit WebGlTarget(const sdk::NoParams&) {}

    TargetAbilities abilities() const noexcept override {
        return {.triangle = true,
                .vertex_colors = true,
                .textures = true,
                .textured_numbers = true,
                .second_uv = true,
                .vertex_channels = true,
                .normal_maps = true,
                .emission = true,
                .occlusion = true,
                .opacity = true,
                .shadows = true,
                .display = true};
    }
    void write(const ExportedScene& scene, FileSink& files) const override {
        PageArrays arrays;
        const std::string json = text_of(scene_json(scene, arrays));
        target::write(files, main_file(),
                      filled(candela_webgl_page,
                             {{"TITLE", html_text(scene.title)},
                              {"STYLE", std::string(candela_webgl_style) + candela_webgl_editor_style},
                              {"SCENE", script_json(json)},
                              {"ARRAYS", arrays.html()},
                              {"CODEMIRROR", candela_webgl_codemirror},
                              {"SCRIPT", candela_webgl_script}}));
    }
    const char* main_file() const noexcept override { return "scene.html"; }
    bool can_draw() const noexcept override { return true; }

    void draw(const char* directory, const char* picture, ProgramRunner& programs) const override {
        draw_page(std::string(directory) + "/" + main_file(), picture, programs);
    }
};

}  // namespace

}  // namespace candela::webgl_target

using candela::webgl_target::WebGlTarget;

CANDELA_PLUGIN(
    target, WebGlTarget, candela::sdk::k_no_fields,
    {.title = "WebGL",
     .summary = "one HTML page with WebGL 2 in which to look around, switch models and move sliders"})
