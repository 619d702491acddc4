#include "import/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "import/readers.h"

import candela.api;
import candela.util;

namespace importing::gltf {

namespace {

/// The factor of that name; all ones by default.
std::vector<double> factor_of(const Json& object, const char* name, std::size_t count) {
    std::vector<double> factor = numbers(object, name, count);
    if (factor.empty()) factor.assign(count, 1);
    for (double& channel : factor) channel = std::clamp(channel, 0.0, 1.0);
    return factor;
}

/// A parameter, in four digits; one number if it is grey.
void add(Material& to, const char* parameter, std::vector<double> value) {
    to.values.emplace_back(parameter, shortened(std::move(value)));
}

/// The reflectance of a dielectric at normal incidence, its largest channel.
double dielectric_of(const Json& extensions) {
    const double ior = number(object_of(extensions, "KHR_materials_ior"), "ior", 1.5);
    const Json& specular = object_of(extensions, "KHR_materials_specular");
    const std::vector<double> color = numbers(specular, "specularColorFactor", 3);
    const double tint = color.empty() ? 1 : *std::ranges::max_element(color);
    return std::clamp(number(specular, "specularFactor", 1), 0.0, 1.0) *
           std::clamp(std::pow((ior - 1) / (ior + 1), 2) * tint, 0.0, 1.0);
}

/// Whether two normal maps, or null, are the same on a surface.
bool tilts_alike(const Json* a, const Json* b) {
    if (a == nullptr || b == nullptr) return a == b;
    const auto transform = [](const Json* map) -> const Json& {
        return object_of(object_of(*map, "extensions"), "KHR_texture_transform");
    };
    return index_of(*a, "index") == index_of(*b, "index") &&
           number(*a, "scale", 1) == number(*b, "scale", 1) &&
           index_of(*a, "texCoord").value_or(0) == index_of(*b, "texCoord").value_or(0) &&
           transform(a) == transform(b);
}

}  // namespace

Materials::Materials(Container& container, candela::Registry& registry, Model& model)
    : json_(container.json()), model_(model), textures_(container, registry, model) {}

Material Materials::material(std::size_t index) {
    const Json& from = array_of(json_, "materials")[index];
    const std::string name = text_of(from, "name");
    const std::string shown =
        name.empty() ? fmt::format("material {}", index) : fmt::format("material '{}'", name);
    const Json& extensions = object_of(from, "extensions");
    const Json* const glossy = find(extensions, "KHR_materials_pbrSpecularGlossiness");
    Material result = find(extensions, "KHR_materials_unlit") != nullptr ? unlit(from, shown)
                      : glossy != nullptr ? specular_glossiness(from, *glossy, shown)
                                          : metallic_roughness(from, shown);
    result.name = name;
    return result;
}

Material Materials::unlit(const Json& from, const std::string& name) {
    const Json& pbr = object_of(from, "pbrMetallicRoughness");
    const std::vector<double> base = factor_of(pbr, "baseColorFactor", 4);
    Material result{.name = {}, .reflection = "unlit", .color = encoded(base)};
    textures_.show(pbr, "baseColorTexture", name, base, result);
    add_opacity(from, pbr, "baseColorTexture", base[3], name, result);
    return result;
}

Material Materials::metallic_roughness(const Json& from, const std::string& name) {
    const Json& pbr = object_of(from, "pbrMetallicRoughness");
    const std::vector<double> base = factor_of(pbr, "baseColorFactor", 4);
    const double metallic = std::clamp(number(pbr, "metallicFactor", 1), 0.0, 1.0);
    const double roughness = std::clamp(number(pbr, "roughnessFactor", 1), 0.0, 1.0);
    Material result{.name = {}, .reflection = "metallic-roughness", .color = encoded(base)};
    textures_.show(pbr, "baseColorTexture", name, base, result);
    const auto map = textures_.texture(pbr, "metallicRoughnessTexture", name);
    const Json& extensions = object_of(from, "extensions");
    // Metals mirror surroundings, which a scene does not have: ambient light stands for half of them.
    const double dielectric = dielectric_of(extensions);
    add(map, Channel::blue, "ka", {metallic * (dielectric - 0.5)}, {1 - dielectric}, result);
    add(map, Channel::blue, "metallic", {metallic}, {0}, result);
    add(map, Channel::green, "roughness", {roughness}, {0}, result);
    add_extensions(extensions, name, result);
    textures_.tilt_normals(from, name, result);
    add_emission(from, name, result);
    add_occlusion(from, name, result);
    add_opacity(from, pbr, "baseColorTexture", base[3], name, result);
    note_losses(from);
    return result;
}

Material Materials::specular_glossiness(const Json& from, const Json& extension, const std::string& name) {
    const std::vector<double> base = factor_of(extension, "diffuseFactor", 4);
    const std::vector<double> specular = factor_of(extension, "specularFactor", 3);
    const double glossiness = std::clamp(number(extension, "glossinessFactor", 1), 0.0, 1.0);
    Material result{.name = {}, .reflection = "specular-glossiness", .color = encoded(base)};
    textures_.show(extension, "diffuseTexture", name, base, result);
    const auto map = textures_.texture(extension, "specularGlossinessTexture", name);
    std::vector<double> mean = specular;
    for (std::size_t k = 0; k < 3 && map; ++k) mean[k] *= map->image->means.linear[k];
    const double diffuse = 1 - *std::ranges::max_element(mean);
    importing::gltf::add(result, "ka", {diffuse + 0.5 * (1 - diffuse)});
    add(map, Channel::rgb, "specular_color", specular, {0}, result);
    add(map, Channel::alpha, "glossiness", {glossiness}, {0}, result);
    textures_.tilt_normals(from, name, result);
    add_emission(from, name, result);
    add_occlusion(from, name, result);
    add_opacity(from, extension, "diffuseTexture", base[3], name, result);
    note_losses(from);
    return result;
}

void Materials::add(const std::optional<Textures::Placed>& map, Channel channel, const char* parameter,
                    const std::vector<double>& scale, const std::vector<double>& offset, Material& to) {
    std::vector<double> value = scale;
    for (std::size_t k = 0; k < value.size(); ++k) value[k] += offset[std::min(k, offset.size() - 1)];
    if (map) value = textures_.map(*map, channel, parameter, scale, offset, to);
    importing::gltf::add(to, parameter, std::move(value));
}

void Materials::add_extensions(const Json& extensions, const std::string& name, Material& to) {
    const auto add_number = [&](const Json& from, const char* key, const char* parameter, double otherwise,
                                double low, double high) {
        importing::gltf::add(to, parameter, {std::clamp(number(from, key, otherwise), low, high)});
    };
    // A factor of 0 to 1 times a texture, if there is one.
    const auto add_share = [&](const Json& from, const char* key, const char* texture, Channel channel,
                               const char* parameter, double otherwise) {
        const double factor = std::clamp(number(from, key, otherwise), 0.0, 1.0);
        add(textures_.texture(from, texture, name), channel, parameter, {factor}, {0}, to);
    };
    const auto add_color = [&](const Json& from, const char* key, const char* texture, const char* parameter,
                               double otherwise, double high) {
        std::vector<double> color = numbers(from, key, 3);
        const auto map = textures_.texture(from, texture, name);
        if (color.empty() && (!map || otherwise == 0)) return;
        if (color.empty()) color.assign(3, otherwise);
        for (double& channel : color) channel = std::clamp(channel, 0.0, high);
        add(map, Channel::rgb, parameter, color, {0}, to);
    };
    constexpr double k_largest_index = 100;
    if (const Json* const index = find(extensions, "KHR_materials_ior")) {
        const double ior = number(*index, "ior", 1.5);  // 0: infinite
        importing::gltf::add(to, "ior", {ior <= 0 ? 0 : std::clamp(ior, 1.0, k_largest_index)});
    }
    if (const Json* const specular = find(extensions, "KHR_materials_specular")) {
        add_share(*specular, "specularFactor", "specularTexture", Channel::alpha, "specular", 1);
        add_color(*specular, "specularColorFactor", "specularColorTexture", "specular_color", 1, 1000);
    }
    if (const Json* const coat = find(extensions, "KHR_materials_clearcoat")) {
        add_share(*coat, "clearcoatFactor", "clearcoatTexture", Channel::red, "clearcoat", 0);
        add_share(*coat, "clearcoatRoughnessFactor", "clearcoatRoughnessTexture", Channel::green,
                  "clearcoat_roughness", 0);
    }
    if (const Json* const sheen = find(extensions, "KHR_materials_sheen")) {
        add_color(*sheen, "sheenColorFactor", "sheenColorTexture", "sheen_color", 0, 1);
        add_share(*sheen, "sheenRoughnessFactor", "sheenRoughnessTexture", Channel::alpha, "sheen_roughness",
                  0);
    }
    if (const Json* const grain = find(extensions, "KHR_materials_anisotropy")) {
        const auto map = textures_.texture(*grain, "anisotropyTexture", name);
        const double strength = std::clamp(number(*grain, "anisotropyStrength", 0), 0.0, 1.0);
        add(map, Channel::blue, "anisotropy_strength", {strength}, {0}, to);
        const double angle = number(*grain, "anisotropyRotation", 0) + (map ? direction_in(*map) : 0);
        importing::gltf::add(to, "anisotropy_rotation",
                             {360 * std::remainder(angle / (2 * std::numbers::pi), 1)});
    }
    if (const Json* const film = find(extensions, "KHR_materials_iridescence")) {
        add_share(*film, "iridescenceFactor", "iridescenceTexture", Channel::red, "iridescence", 0);
        add_number(*film, "iridescenceIor", "iridescence_ior", 1.3, 1, k_largest_index);
        const auto thickness = [&](const char* key, double otherwise) {
            return std::clamp(number(*film, key, otherwise), 0.0, 1e5);
        };
        const double most = thickness("iridescenceThicknessMaximum", 400);
        const auto map = textures_.texture(*film, "iridescenceThicknessTexture", name);
        const double least = map ? thickness("iridescenceThicknessMinimum", 100) : 0;
        add(map, Channel::green, "iridescence_thickness", {most - least}, {least}, to);
    }
}

void Materials::add_emission(const Json& from, const std::string& name, Material& to) {
    std::vector<double> factor = numbers(from, "emissiveFactor", 3);
    for (double& channel : factor) channel = std::clamp(channel, 0.0, 1.0);
    const Json& extension = object_of(object_of(from, "extensions"), "KHR_materials_emissive_strength");
    constexpr double k_strongest = 1e30;
    const double strength = std::clamp(number(extension, "emissiveStrength", 1), 0.0, k_strongest);
    if (strength == 0 || std::ranges::none_of(factor, [](double x) { return x > 0; })) return;
    for (double& channel : factor) channel *= strength;
    set_emission(factor, to);
    const auto map = textures_.texture(from, "emissiveTexture", name);
    if (!map) return;
    for (double& channel : factor) channel /= to.emission_strength;
    const std::size_t maps = to.maps.size();
    std::vector<double> mean = textures_.map(*map, Channel::rgb, "emission", factor, {0}, to);
    if (to.maps.size() > maps) return;
    // The picture has one colour.
    for (double& channel : mean) channel *= to.emission_strength;
    set_emission(mean, to);
}

void Materials::add_occlusion(const Json& from, const std::string& name, Material& to) {
    const Json& info = object_of(from, "occlusionTexture");
    const double strength = std::clamp(number(info, "strength", 1), 0.0, 1.0);
    if (strength == 0) return;
    if (const auto map = textures_.texture(from, "occlusionTexture", name))
        add(map, Channel::red, "occlusion", {strength}, {1 - strength}, to);
}

void Materials::add_opacity(const Json& from, const Json& colors, const char* texture, double factor,
                            const std::string& name, Material& to) {
    const std::string mode = text_of(from, "alphaMode");
    if (mode != "MASK" && mode != "BLEND") return;
    const double cutoff = mode == "MASK" ? number(from, "alphaCutoff", 0.5) : 0;
    if (mode == "MASK" && cutoff <= 0) return;  // it is there everywhere
    // Nothing reaches a cutoff above 1.
    const double scale = cutoff > 1 ? 0 : std::clamp(factor, 0.0, 1.0);
    // Where the colour has no texture, that has been noted.
    const auto map = to.color_map ? textures_.texture(colors, texture, name) : std::nullopt;
    const bool is_opaque = !map || (map->image->means.is_opacity_equal && map->image->means.opacity == 1);
    const bool has_factors = has_vertex_alpha(from);
    if (is_opaque && !has_factors && (mode == "MASK" ? scale >= cutoff : scale == 1)) return;
    // A product has the factor at the vertices: pictures are left out of files without texture coordinates.
    const bool is_product = has_factors && map && !map->image->means.is_opacity_equal && scale > 0;
    add(map, Channel::alpha, "opacity", {is_product ? 1 : scale}, {0}, to);
    if (has_factors)
        to.maps.push_back({.parameter = "opacity",
                           .attribute = "color",
                           .channel = "a",
                           .scale = {is_product ? scale : to.values.back().second.front()}});
    if (mode == "MASK") importing::gltf::add(to, "opacity_cutoff", {std::min(cutoff, 1.0)});
}

bool Materials::has_vertex_alpha(const Json& material) const {
    const auto number = static_cast<std::size_t>(&material - &array_of(json_, "materials").front());
    const auto has_alpha = [&](const Json& primitive) {
        if (index_of(primitive, "material") != number) return false;
        const auto colors = index_of(object_of(primitive, "attributes"), "COLOR_0");
        const Json* const accessor = element(array_of(json_, "accessors"), colors);
        return accessor != nullptr && text_of(*accessor, "type") == "VEC4";
    };
    return std::ranges::any_of(array_of(json_, "meshes"), [&](const Json& mesh) {
        return std::ranges::any_of(array_of(mesh, "primitives"), has_alpha);
    });
}

double Materials::direction_in(const Textures::Placed& map) {
    const Means& means = map.image->means;
    if (!means.are_equal[0] || !means.are_equal[1])
        model_.count("directions", "a texture of the direction of anisotropy becomes its mean",
                     "{} textures of the direction of anisotropy become their means");
    // 127 and 128 of 255 stand for 0.
    const double across = std::round(254 * means.stored[1] - 127) / 127, along = 2 * means.stored[0] - 1;
    return std::atan2(across, along);
}

void Materials::note_coat_normals(const Json& from) {
    const Json& coat = object_of(object_of(from, "extensions"), "KHR_materials_clearcoat");
    const Json* const of_coat = find(coat, "clearcoatNormalTexture");
    const Json* const of_surface = find(from, "normalTexture");
    if (number(coat, "clearcoatFactor", 0) <= 0 || tilts_alike(of_coat, of_surface)) return;
    if (of_coat != nullptr)
        model_.count("coats' normals",
                     "the normal map of a clear coat is left out, which has its surface's normals",
                     "the normal maps of {} clear coats are left out, which have their surfaces' normals");
    else
        model_.count("smooth coats", "a clear coat that is smooth in the file has its surface's normal map",
                     "{} clear coats that are smooth in the file have their surfaces' normal maps");
}

void Materials::note_losses(const Json& from) {
    note_coat_normals(from);
    const Json& extensions = object_of(from, "extensions");
    for (const auto& [name, unused] : extensions.items()) {
        constexpr std::array k_read = {"KHR_materials_ior",
                                       "KHR_materials_specular",
                                       "KHR_materials_clearcoat",
                                       "KHR_materials_sheen",
                                       "KHR_materials_anisotropy",
                                       "KHR_materials_iridescence",
                                       "KHR_materials_emissive_strength",
                                       "KHR_materials_pbrSpecularGlossiness"};
        if (std::ranges::find(k_read, name) != k_read.end()) continue;
        model_.count(name, fmt::format("the extension '{}' of a material is left out", name),
                     fmt::format("the extension '{}' of {{}} materials is left out", name));
    }
}

}  // namespace importing::gltf
