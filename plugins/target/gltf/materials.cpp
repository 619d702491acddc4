#include "materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "candela/color.h"
#include "candela/target/mean_materials.h"
#include "candela/target/renderers.h"
#include "candela/target/textures.h"
#include "metallic_roughness.h"

namespace candela::gltf_target {

namespace {

constexpr float k_dielectric =
    0.04f;  // the reflectance of glTF's materials at normal incidence, for an index of 1.5

float largest(Vec3 v) { return std::max({v.x, v.y, v.z}); }
float distance(Vec3 a, Vec3 b) {
    return std::max({std::abs(a.x - b.x), std::abs(a.y - b.y), std::abs(a.z - b.z)});
}
Vec3 at_most_one(Vec3 v) { return {std::min(v.x, 1.0f), std::min(v.y, 1.0f), std::min(v.z, 1.0f)}; }
Json json_of(Vec3 v) { return {v.x, v.y, v.z}; }

/// glTF 2.0, appendix B: the diffuse light of a dielectric and its mirrored share, blended with a metal.
struct Surface {
    Vec3 base{};
    float metallic = 0;
    float roughness = 1;
    Vec3 mirrored{k_dielectric, k_dielectric, k_dielectric};  // of the dielectric, at normal incidence
    bool has_specular = true;
};

/// The metallic share of a material, which gives its highlights part of the object's colour.
std::optional<float> metalness_of(Vec3 color, Vec3 diffuse, Vec3 mirrored) {
    const float metallic = 1 - diffuse.x / (1 - k_dielectric);
    const float dielectric = (1 - metallic) * k_dielectric;
    const Vec3 expected = metallic * color + Vec3{dielectric, dielectric, dielectric};
    constexpr float k_near = 2e-3f;
    const bool is_metal = diffuse.x == diffuse.y && diffuse.y == diffuse.z && metallic > k_near &&
                          metallic <= 1 && distance(expected, mirrored) < k_near;
    return is_metal ? std::optional(metallic) : std::nullopt;
}

Surface surface_of(const ExportedReflection& model, const ExportedValues& values, Vec3 color,
                   FileSink& files) {
    const std::string_view id = model.id;
    if (const auto principled = target::principled_of(model, values)) {
        files.approximate(fmt::format("{} becomes metallic-roughness", id).c_str());
        // Burley's base does not lack what is mirrored, unlike glTF's.
        const bool is_dimmed = id != "reflection/disney";
        const float mirrored = is_dimmed ? 0 : (1 - principled->metallic) * principled->reflectance;
        return {
            .base = at_most_one((1 / std::max(1 - mirrored, 1e-3f)) * target::times(principled->base, color)),
            .metallic = principled->metallic,
            .roughness = std::sqrt(principled->alpha),
            .mirrored = principled->reflectance * Vec3{1, 1, 1}};
    }
    const Vec3 diffuse = target::rgb_value(model, values, "kd").value_or(Vec3{1, 1, 1});
    const auto highlight = target::highlight_of(model, values);
    if (id == "reflection/unlit") {
        files.approximate("reflection/unlit has its colour also without ambient light");
        return {.base = color};
    }
    if (!highlight || highlight->specular == Vec3{}) {
        // Without the mirrored part, glTF's diffuse light is Lambert's.
        if (id != "reflection/lambert" && id != "reflection/phong" && id != "reflection/blinn-phong")
            files.approximate(fmt::format("{} becomes Lambert's diffuse light", id).c_str());
        return {.base = target::times(diffuse, color), .mirrored = {}, .has_specular = false};
    }
    files.approximate(
        fmt::format("{} becomes metallic-roughness, whose highlights rise towards grazing angles", id)
            .c_str());
    const float alpha = highlight->alpha;
    Surface result{.roughness = std::sqrt(alpha)};
    // At normal incidence facets reflect F D / 4, where D is 1 / alpha^2.
    const float facets = highlight->facets > 0 ? highlight->facets : 4 * alpha * alpha;
    const Vec3 mirrored = at_most_one(facets * highlight->specular);
    if (const auto metallic = metalness_of(color, diffuse, highlight->specular)) {
        result.metallic = *metallic;
        result.base = color;
    } else if (diffuse == Vec3{}) {
        result.metallic = 1;
        result.base = mirrored;
    } else {
        result.mirrored = mirrored;
        // Mirrored light is not available for diffuse reflection.
        result.base =
            at_most_one((1 / std::max(1 - largest(mirrored), 1e-3f)) * target::times(diffuse, color));
    }
    return result;
}

}  // namespace

Json Materials::approximate(const ExportedReflection& model, const ExportedValues& values, Vec3 color) {
    const Surface surface = surface_of(model, values, color, files_);
    Json material = {{"pbrMetallicRoughness",
                      {{"baseColorFactor", {surface.base.x, surface.base.y, surface.base.z, 1}},
                       {"metallicFactor", surface.metallic},
                       {"roughnessFactor", surface.roughness}}}};
    const Vec3 usual{k_dielectric, k_dielectric, k_dielectric};
    if (!surface.has_specular) {
        material["extensions"][k_specular]["specularFactor"] = 0;
    } else if (surface.metallic < 1 && distance(surface.mirrored, usual) > 1e-6f) {
        material["extensions"][k_specular]["specularColorFactor"] =
            json_of((1 / k_dielectric) * surface.mirrored);
    }
    if (material.contains("extensions")) document_.use_extension(k_specular);
    return material;
}

std::size_t Materials::add(const ExportedObject& object, const std::optional<float>& vertex_alpha,
                           bool is_closed) {
    const ExportedReflection& model = scene_.reflections[object.reflection];
    const std::vector<ParamValue> means = target::mean_values(scene_, object);
    ExportedValues values = object.materials[object.reflection];
    values.runtime = means;
    const Rgb decoded_color = decoded(object.color, scene_.image.color_management);
    const Vec3 color{decoded_color.r, decoded_color.g, decoded_color.b};
    const bool is_unlit = std::string_view(model.id) == "reflection/unlit";
    const auto exact = metallic_roughness_material(model, values, color, document_);
    Json material = exact ? *exact : approximate(model, values, color);
    if (exact) {
        maps_.add(object, means, material);
    } else {
        for (const ExportedTexturedNumber& number : object.textured_numbers)
            target::approximate_by_mean(scene_, object, number.parameter, files_);
    }
    material["name"] = object.label;
    if (is_unlit) {
        // The rest is for programs that do not read the extension.
        material["extensions"]["KHR_materials_unlit"] = Json::object();
        document_.use_extension("KHR_materials_unlit");
    }
    maps_.add_color(object, vertex_alpha, material);
    maps_.add_normals(object, material);
    if (is_unlit && target::emission_of(object, scene_.image.color_management) != Rgb{})
        files_.approximate("what an unlit material emits is left out by programs that show the file");
    maps_.add_emission(object, material);
    maps_.add_occlusion(object, material);
    if (!is_closed) material["doubleSided"] = true;
    return document_.add("materials", std::move(material));
}

}  // namespace candela::gltf_target
