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

double rounded(double x) { return std::round(1e4 * x) / 1e4; }

/// The factor of that name; all ones by default.
std::vector<double> factor_of(const Json& object, const char* name, std::size_t count) {
    std::vector<double> factor = numbers(object, name, count);
    if (factor.empty()) factor.assign(count, 1);
    for (double& channel : factor) channel = std::clamp(channel, 0.0, 1.0);
    return factor;
}

/// A parameter, in four digits; one number if it is grey.
void add(Material& to, const char* parameter, std::vector<double> value) {
    for (double& x : value) x = rounded(x);
    if (value.size() == 3 && value[0] == value[1] && value[1] == value[2]) value.resize(1);
    to.values.emplace_back(parameter, std::move(value));
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

/// The parts of a material that extensions add, each only if the file has it.
void add_extensions(const Json& extensions, Material& to) {
    const auto add_number = [&](const Json& from, const char* key, const char* parameter, double otherwise,
                                double low, double high) {
        add(to, parameter, {std::clamp(number(from, key, otherwise), low, high)});
    };
    const auto add_color = [&](const Json& from, const char* key, const char* parameter, double high) {
        std::vector<double> color = numbers(from, key, 3);
        if (color.empty()) return;
        for (double& channel : color) channel = std::clamp(channel, 0.0, high);
        add(to, parameter, std::move(color));
    };
    constexpr double k_largest_index = 100;
    if (const Json* const index = find(extensions, "KHR_materials_ior")) {
        const double ior = number(*index, "ior", 1.5);  // 0: infinite
        add(to, "ior", {ior <= 0 ? 0 : std::clamp(ior, 1.0, k_largest_index)});
    }
    if (const Json* const specular = find(extensions, "KHR_materials_specular")) {
        add_number(*specular, "specularFactor", "specular", 1, 0, 1);
        add_color(*specular, "specularColorFactor", "specular_color", 1000);
    }
    if (const Json* const coat = find(extensions, "KHR_materials_clearcoat")) {
        add_number(*coat, "clearcoatFactor", "clearcoat", 0, 0, 1);
        add_number(*coat, "clearcoatRoughnessFactor", "clearcoat_roughness", 0, 0, 1);
    }
    if (const Json* const sheen = find(extensions, "KHR_materials_sheen")) {
        add_color(*sheen, "sheenColorFactor", "sheen_color", 1);
        add_number(*sheen, "sheenRoughnessFactor", "sheen_roughness", 0, 0, 1);
    }
    if (const Json* const grain = find(extensions, "KHR_materials_anisotropy")) {
        add_number(*grain, "anisotropyStrength", "anisotropy_strength", 0, 0, 1);
        const double turns = number(*grain, "anisotropyRotation", 0) / (2 * std::numbers::pi);
        add(to, "anisotropy_rotation", {360 * std::remainder(turns, 1)});
    }
    if (const Json* const film = find(extensions, "KHR_materials_iridescence")) {
        add_number(*film, "iridescenceFactor", "iridescence", 0, 0, 1);
        add_number(*film, "iridescenceIor", "iridescence_ior", 1.3, 1, k_largest_index);
        add_number(*film, "iridescenceThicknessMaximum", "iridescence_thickness", 400, 0, 1e5);
    }
}

/// Some exporters write a KHR_texture_transform that changes nothing.
bool is_moved(const Json& info) {
    const Json* const transform = find(object_of(info, "extensions"), "KHR_texture_transform");
    if (transform == nullptr) return false;
    const std::vector<double> offset = numbers(*transform, "offset", 2),
                              scale = numbers(*transform, "scale", 2);
    return (!offset.empty() && offset != std::vector<double>{0, 0}) ||
           (!scale.empty() && scale != std::vector<double>{1, 1}) || number(*transform, "rotation", 0) != 0;
}

}  // namespace

Materials::Materials(Container& container, candela::Registry& registry, Model& model)
    : container_(container), json_(container.json()), registry_(registry), model_(model) {}

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
    MeasuredImage* image = nullptr;
    if (const Json* const info = find(pbr, "baseColorTexture")) image = show(*info, name, result);
    cut_out(from, base[3], image, result);
    return result;
}

Material Materials::metallic_roughness(const Json& from, const std::string& name) {
    const Json& pbr = object_of(from, "pbrMetallicRoughness");
    const std::vector<double> base = factor_of(pbr, "baseColorFactor", 4);
    double metallic = std::clamp(number(pbr, "metallicFactor", 1), 0.0, 1.0);
    double roughness = std::clamp(number(pbr, "roughnessFactor", 1), 0.0, 1.0);
    Material result{.name = {}, .reflection = "metallic-roughness", .color = encoded(base)};
    MeasuredImage* image = nullptr;
    if (const Json* const info = find(pbr, "baseColorTexture")) image = show(*info, name, result);
    if (const Json* const info = find(pbr, "metallicRoughnessTexture")) {
        if (const MeasuredImage* const map = image_of(*info, name)) {
            roughness *= map->means.stored[1];
            metallic *= map->means.stored[2];
            model_.count("roughness maps", "only the mean of a texture of metalness and roughness is used",
                         "only the means of {} textures of metalness and roughness are used");
        }
    }
    const Json& extensions = object_of(from, "extensions");
    // Metals mirror surroundings, which a scene does not have: ambient light stands for half of them.
    add(result, "ka", {(1 - metallic) * (1 - dielectric_of(extensions)) + 0.5 * metallic});
    add(result, "metallic", {metallic});
    add(result, "roughness", {roughness});
    add_extensions(extensions, result);
    cut_out(from, base[3], image, result);
    note_losses(from);
    return result;
}

Material Materials::specular_glossiness(const Json& from, const Json& extension, const std::string& name) {
    const std::vector<double> base = factor_of(extension, "diffuseFactor", 4);
    std::vector<double> specular = factor_of(extension, "specularFactor", 3);
    MeasuredImage* image = nullptr;
    double glossiness = std::clamp(number(extension, "glossinessFactor", 1), 0.0, 1.0);
    Material result{.name = {}, .reflection = "specular-glossiness", .color = encoded(base)};
    if (const Json* const info = find(extension, "diffuseTexture")) image = show(*info, name, result);
    if (const Json* const info = find(extension, "specularGlossinessTexture")) {
        if (const MeasuredImage* const map = image_of(*info, name)) {
            for (std::size_t k = 0; k < 3; ++k) specular[k] *= map->means.linear[k];
            glossiness *= map->means.opacity;
            model_.count("gloss maps", "only the mean of a texture of highlights and gloss is used",
                         "only the means of {} textures of highlights and gloss are used");
        }
    }
    const double diffuse = 1 - *std::ranges::max_element(specular);
    add(result, "ka", {diffuse + 0.5 * (1 - diffuse)});
    add(result, "specular_color", specular);
    add(result, "glossiness", {glossiness});
    cut_out(from, base[3], image, result);
    note_losses(from);
    return result;
}

void Materials::cut_out(const Json& from, double factor, MeasuredImage* image, Material& to) {
    const std::string mode = text_of(from, "alphaMode");
    if (mode != "MASK" && mode != "BLEND") return;
    const double level = mode == "BLEND" ? 0.5 : number(from, "alphaCutoff", 0.5) / std::max(factor, 1e-3);
    const bool is_opaque = factor >= 1 && (image == nullptr || image->opacity.bytes.empty());
    if (is_opaque || (mode == "MASK" && level <= 0)) return;
    const bool is_wanted = image != nullptr && level <= 1 && image->opacity.is_cut_by(level) &&
                           (mode == "MASK" || (factor > level && image->opacity.is_clear_cut));
    if (is_wanted) {
        if (!image->cutout) {
            image->cutout = model_.cutouts.size();
            model_.cutouts.push_back(
                {fmt::format("{}_opacity_{}.pgm", image->file.file.stem().string(), model_.cutouts.size()),
                 image->opacity.pgm()});
        }
        to.cutout = image->cutout;
        to.cutout_level = level;
        if (mode == "MASK") return;
        return model_.count("cut-outs", "a transparent material is cut out where its texture is half opaque",
                            "{} transparent materials are cut out where their textures are half opaque");
    }
    const bool is_all_there =
        mode == "MASK" && level <= 1 && (image == nullptr || image->opacity.is_all(level));
    if (is_all_there) return;
    model_.count("opacity", "the opacity of a material is left out; it is opaque",
                 "the opacity of {} materials is left out; they are opaque");
}

void Materials::note_losses(const Json& from) {
    if (find(from, "normalTexture") != nullptr)
        model_.count("normal maps", "a normal map is left out", "{} normal maps are left out");
    if (find(from, "occlusionTexture") != nullptr)
        model_.count("occlusion maps", "an occlusion map is left out", "{} occlusion maps are left out");
    const std::vector<double> emission = numbers(from, "emissiveFactor", 3);
    if (std::ranges::any_of(emission, [](double x) { return x > 0; }))
        model_.count("emission", "the light that a material emits is left out",
                     "the light that {} materials emit is left out");
    const Json& extensions = object_of(from, "extensions");
    for (const auto& [name, unused] : extensions.items()) {
        constexpr std::array k_read = {"KHR_materials_ior",
                                       "KHR_materials_specular",
                                       "KHR_materials_clearcoat",
                                       "KHR_materials_sheen",
                                       "KHR_materials_anisotropy",
                                       "KHR_materials_iridescence",
                                       "KHR_materials_pbrSpecularGlossiness"};
        if (std::ranges::find(k_read, name) != k_read.end()) continue;
        model_.count(name, fmt::format("the extension '{}' of a material is left out", name),
                     fmt::format("the extension '{}' of {{}} materials is left out", name));
    }
    const auto note_maps = [&](const char* extension, const char* kind) {
        for (const auto& [key, unused] : object_of(extensions, extension).items())
            if (key.ends_with("Texture"))
                model_.count(
                    kind, fmt::format("a texture of {} is left out; its factor applies everywhere", kind),
                    fmt::format("{{}} textures of {} are left out; their factors apply everywhere", kind));
    };
    note_maps("KHR_materials_specular", "specular reflectance");
    note_maps("KHR_materials_clearcoat", "clear coats");
    note_maps("KHR_materials_sheen", "sheen");
    note_maps("KHR_materials_anisotropy", "anisotropy");
    note_maps("KHR_materials_iridescence", "iridescence");
}

Materials::MeasuredImage* Materials::show(const Json& info, const std::string& material, Material& to) {
    if (index_of(info, "texCoord").value_or(0) != 0) {
        model_.count("texture coordinates", "a texture that uses further texture coordinates is left out",
                     "{} textures that use further texture coordinates are left out");
        return nullptr;
    }
    if (is_moved(info))
        model_.count("KHR_texture_transform",
                     "the extension 'KHR_texture_transform' of a texture is left out",
                     "the extension 'KHR_texture_transform' of {} textures is left out");
    MeasuredImage* const image = image_of(info, material);
    if (image == nullptr) return nullptr;
    const Json& texture = *element(array_of(json_, "textures"), index_of(info, "index"));
    if (const Json* const sampler = element(array_of(json_, "samplers"), index_of(texture, "sampler"))) {
        const std::size_t s = index_of(*sampler, "wrapS").value_or(10497),
                          t = index_of(*sampler, "wrapT").value_or(10497);
        to.clamps = s == 33071 && t == 33071;
        if (s == 33648 || t == 33648) model_.note("mirrored repetition of textures becomes plain repetition");
        if (s != t) model_.note("textures that repeat in only one direction repeat in both");
    }
    if (!image->index) {
        image->index = model_.images.size();
        model_.images.push_back(image->file);
    }
    to.image = image->index;
    return image;
}

Materials::MeasuredImage* Materials::image_of(const Json& info, const std::string& material) {
    const Json* const texture = element(array_of(json_, "textures"), index_of(info, "index"));
    std::optional<std::size_t> source;
    if (texture != nullptr) {
        source = index_of(*texture, "source");
        // Given two formats, prefer the one that every program reads.
        for (const char* const extension :
             {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu"})
            if (!source) source = index_of(object_of(object_of(*texture, "extensions"), extension), "source");
    }
    if (!source || element(array_of(json_, "images"), source) == nullptr) {
        model_.count("no textures", fmt::format("the picture of a texture of {} is missing", material),
                     fmt::format("the pictures of {{}} textures are missing, the first of {}", material));
        return nullptr;
    }
    return image_at(*source, material);
}

Materials::MeasuredImage* Materials::image_at(std::size_t index, const std::string& material) {
    const auto [known, is_new] = images_.try_emplace(index);
    if (!is_new) return known->second ? &*known->second : nullptr;
    try {
        Image found = container_.image(index);
        const auto [pixels, other_format] = read_image(found, registry_);
        found.brightness = brightness_of(pixels);
        if (!other_format.empty())
            model_.count("misnamed pictures",
                         fmt::format("a texture of {} is read as {}, according to its content", material,
                                     other_format),
                         fmt::format("{{}} textures are read according to their content, the first "
                                     "of {} as {}",
                                     material, other_format));
        known->second =
            MeasuredImage{.file = std::move(found), .means = means_of(pixels), .opacity = opacity_of(pixels)};
        return &*known->second;
    } catch (const candela::Error& problem) {
        model_.count(
            "pictures", fmt::format("a texture of {} is left out: {}", material, problem.what()),
            fmt::format("{{}} textures are left out, the first of {}: {}", material, problem.what()));
        return nullptr;
    }
}

}  // namespace importing::gltf
