#include "scene_json.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/color.h"
#include "candela/target/arrays.h"
#include "candela/target/glsl.h"
#include "candela/target/kernels.h"
#include "candela/target/mirror.h"
#include "candela/target/renderers.h"
#include "candela/target/textures.h"
#include "lights.h"
#include "page_json.h"
#include "uniforms.h"

namespace candela::three_target {

using namespace target;

namespace {

/// Filled like by three.js's own materials, with its uniform variable: a logarithm of the distance.
constexpr GlslDepth k_logarithmic_depth{
    .uniform = "uniform float logDepthBufFC;\n",
    .statement =
        "    gl_FragDepth = is_orthographic ? gl_FragCoord.z : 0.5 * logDepthBufFC * log2(1.0 + 1.0 / "
        "gl_FragCoord.w);\n",
    .not_behind = "<="};

/// The models whose normal is interpolated between the vertices, as three.js does it.
bool is_smooth(const ExportedShading& shading) {
    constexpr std::array<std::string_view, 4> k_ids{"shading/phong", "shading/angle-weighted",
                                                    "shading/area-weighted", "shading/max-weighted"};
    return std::ranges::find(k_ids, shading.id) != k_ids.end();
}

Vec3 intensities(Vec3 color, ColorEncoding encoding) {
    const Rgb c = decoded(color, encoding);
    return {c.r, c.g, c.b};
}

class Writer {
  public:
    Writer(const ExportedScene& scene, PageArrays& arrays) : scene_(scene), arrays_(arrays) {}

    Json write() {
        for (const ExportedModel& model : models_of(scene_)) {
            if (model.plugin->kernel.text == nullptr)
                throw std::runtime_error(
                    fmt::format("{} has no kernel, and three.js has no equivalent model", model.id));
        }
        std::vector<Json> meshes;
        std::vector<Box> boxes;
        for (std::size_t i = 0; i < scene_.objects.size(); ++i) {
            const ExportedMesh mesh = scene_.geometry->in_world_space(i);
            meshes.push_back(mesh_json(mesh, scene_.objects[i].shading));
            boxes.push_back(box_of(mesh));
            is_closed_.push_back(mesh.closed);
            is_solid_.push_back(mesh.is_solid);
            middles_.push_back(middle_of(mesh));
        }
        const auto lights = own_lights(scene_, boxes);
        Json objects = Json::array();
        for (std::size_t i = 0; i < scene_.objects.size(); ++i)
            objects.push_back(object_json(i, std::move(meshes[i]), lights.has_value()));
        Json json = {
            {"title", scene_.title},
            {"image", image_json()},
            {"observer", observer_json()},
            {"shaders", shaders_json()},
            {"light_counts", light_counts(scene_)},
            {"light_table", arrays_.put(std::as_bytes(std::span<const std::int32_t>(light_table(scene_))))},
            {"light_table_width", k_light_table_width},
            {"tables", arrays_.put(std::as_bytes(scene_.tables))},
            {"table_width", k_table_width},
            {"textures", textures_json()},
            {"lights", lights.value_or(Json::array())},
            {"objects", std::move(objects)}};
        if (scene_.has_shadows) json["shadows"] = shadows_json(scene_, arrays_);
        if (has_mirror_images(scene_))
            json["radiance"] = {
                {"width", k_radiance_width},
                {"texels", arrays_.put(std::as_bytes(std::span<const float>(radiance_texels(scene_))))}};
        return json;
    }

  private:
    Json mesh_json(const ExportedMesh& mesh, std::size_t shading) {
        const std::size_t count = mesh.vertex_count;
        const auto put = [&](const auto& vectors) {
            return vectors
                       ? Json(arrays_.put(std::as_bytes(std::span<const float>(interleaved(vectors, count)))))
                       : Json();
        };
        return {{"triangles", mesh.triangle_count()},
                {"indices", arrays_.put(std::as_bytes(mesh.indices))},
                {"position", put(mesh.position)},
                {"normals", Json::array({put(mesh.normals[mesh.normals_of[shading]])})},
                {"uv", scene_.needs_uv ? put(mesh.uv) : Json()},
                {"dpdu", scene_.needs_derivatives ? put(mesh.dpdu) : Json()},
                {"dpdv", scene_.needs_derivatives ? put(mesh.dpdv) : Json()},
                {"color", put(mesh.color)},
                {"channels", arrays_.put(mesh.channels)},
                {"has_second_uv", static_cast<bool>(mesh.second_uv)}};
    }

    static Box box_of(const ExportedMesh& mesh) {
        const auto range = [&](const float* x) {
            return std::ranges::minmax(std::span(x, mesh.vertex_count));
        };
        if (mesh.vertex_count == 0) return {};
        const auto x = range(mesh.position.x), y = range(mesh.position.y), z = range(mesh.position.z);
        return {.low = {x.min, y.min, z.min}, .high = {x.max, y.max, z.max}};
    }

    /// Whether three.js's Lambert material applies: with its own lights and normals, and colours that it can
    /// express.
    Json lambert_json(const ExportedObject& object, const Json& mesh, Vec3 color) const {
        const ExportedReflection& model = scene_.reflections[object.reflection];
        const ExportedValues& values = object.materials[object.reflection];
        const auto ka = rgb_value(model, values, "ka"), kd = rgb_value(model, values, "kd");
        if (std::string_view(model.id) != "reflection/lambert" || !ka || !kd ||
            !is_smooth(scene_.shadings[object.shading]) || !material_pictures(object).empty())
            return {};
        Vec3 ambient{};
        for (const ExportedLight& light : scene_.lights)
            ambient = ambient + Vec3{light.ambient.r, light.ambient.g, light.ambient.b};
        const Rgb emission = emission_of(object, scene_.image.color_management);
        const Vec3 emissive =
            object.occlusion * times(times(*ka, color), ambient) + Vec3{emission.r, emission.g, emission.b};
        // Emitted light is not multiplied by the colours of vertices.
        if (!mesh["color"].is_null() && !(emissive == Vec3{})) return {};
        return {{"color", vector_json(times(*kd, color))}, {"emissive", vector_json(emissive)}};
    }

    Json object_json(std::size_t index, Json mesh, bool has_own_lights) const {
        const ExportedObject& object = scene_.objects[index];
        const ExportedShading& shading = scene_.shadings[object.shading];
        const Vec3 color = intensities(object.color, scene_.image.color_management);
        Json lambert = has_own_lights ? lambert_json(object, mesh, color) : Json();
        Json json = {{"label", object.label},
                     {"closed", is_closed_[index]},
                     {"rate", rate_name(shading.rate)},
                     {"sees_triangle", shading.needs.triangle},
                     {"reflection", object.reflection},
                     {"shading", object.shading},
                     {"lambert", std::move(lambert)},
                     {"uniforms",
                      {{"object_color", vector_json(color)},
                       {"material", struct_json(scene_.reflections[object.reflection],
                                                object.materials[object.reflection])},
                       {"shading", struct_json(shading, object.shadings[object.shading])}}},
                     {"material", target::all_textured_numbers(object).empty() ? Json() : Json(index)},
                     {"normal_map", object.normal_map == nullptr ? Json() : Json(index)},
                     {"material_pictures", pictures_json(object)},
                     {"mesh", std::move(mesh)}};
        const Rgb emission = emission_of(object, scene_.image.color_management);
        put_opacity(json, scene_, index);
        if (has_emission(scene_)) json["uniforms"]["object_emission"] = {emission.r, emission.g, emission.b};
        if (has_occlusion(scene_)) json["uniforms"]["object_occlusion"] = object.occlusion;
        if (scene_.has_shadows) {
            json["is_solid"] = bool{is_solid_[index]};
            json["uniforms"]["object_index"] = index;
            json["uniforms"]["is_shadowed"] = object.receives_shadows;
            json["uniforms"]["blocks_both_sides"] = !is_solid_[index];
            json["uniforms"]["object_middle"] = vector_json(middles_[index]);
        }
        return json;
    }

    Json shaders_json() const {
        const GlslParts glsl = glsl_of(scene_, k_logarithmic_depth);
        return {{"prelude", glsl.prelude},
                {"texture", glsl.texture},
                {"lights", glsl.lights},
                {"reflections", glsl.reflections},
                {"shadings", glsl.shadings},
                {"materials", glsl.materials},
                {"normal_maps", glsl.normal_maps},
                {"opacities", glsl.opacities},
                {"vertex", glsl.vertex},
                {"fragment", glsl.fragment},
                {"screen", glsl.screen},
                {"accumulate", glsl.accumulate},
                {"encode", glsl.encode}};
    }

    Json textures_json() {
        Json textures = Json::array();
        for (const PageTexture& texture : put_textures(scene_, arrays_)) {
            textures.push_back({{"width", texture.width},
                                {"height", texture.height},
                                {"encoded", texture.is_encoded},
                                {"pixels", texture.pixels}});
        }
        return textures;
    }

    /// Shown as it is written, whatever the exposure.
    static Json background_json(const ExportedImage& image) {
        return vector_json(1 / image.exposure * intensities(image.background, image.color_management));
    }

    Json image_json() const {
        const ExportedImage& image = scene_.image;
        Json samples = Json::array();
        for (const ExportedSample& s : image.samples) samples.push_back({shortest(s.x), shortest(s.y)});
        return {{"width", image.width},
                {"height", image.height},
                {"samples", std::move(samples)},
                {"background", background_json(image)},
                {"exposure", image.exposure},
                {"tone", static_cast<int>(image.tone)},
                {"is_srgb", image.color_management == ColorEncoding::srgb}};
    }

    Json observer_json() const {
        const ExportedObserver& observer = scene_.observer;
        const bool is_perspective = observer.projection == Projection::perspective;
        return {{"position", vector_json(observer.position)},
                {"look_at", vector_json(observer.look_at)},
                {"up", vector_json(observer.up)},
                {"projection", is_perspective ? "perspective" : "orthographic"},
                {"fov", shortest(observer.fov)},
                {"height", shortest(observer.height)}};
    }

    const ExportedScene& scene_;
    PageArrays& arrays_;
    std::vector<bool> is_closed_, is_solid_;
    std::vector<Vec3> middles_;
};

}  // namespace

Json scene_json(const ExportedScene& scene, PageArrays& arrays) { return Writer(scene, arrays).write(); }

}  // namespace candela::three_target
