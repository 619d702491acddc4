#include "import/gltf_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

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

/// The reflectance of a dielectric at normal incidence: KHR_materials_specular.
std::vector<double> dielectric_of(const Json& from) {
    const Json& extensions = object_of(from, "extensions");
    const double ior = number(object_of(extensions, "KHR_materials_ior"), "ior", 1.5);
    const double usual = std::pow((ior - 1) / (ior + 1), 2);
    const Json& specular = object_of(extensions, "KHR_materials_specular");
    std::vector<double> color = numbers(specular, "specularColorFactor", 3);
    if (color.empty()) color = {1, 1, 1};
    const double factor = std::clamp(number(specular, "specularFactor", 1), 0.0, 1.0);
    for (double& channel : color) channel = factor * std::clamp(usual * channel, 0.0, 1.0);
    return color;
}

std::vector<double> alpha_of(double roughness) { return {std::max(rounded(roughness * roughness), 0.02)}; }

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

Vector encoded(const std::vector<double>& linear) {
    Vector color{};
    for (std::size_t k = 0; k < 3; ++k)
        color[k] =
            std::round(255 * candela::linear_to_srgb(static_cast<float>(std::clamp(linear[k], 0.0, 1.0))));
    return color;
}

Materials::Materials(Container& container, candela::Registry& registry, Model& model)
    : container_(container), json_(container.json()), registry_(registry), model_(model) {}

Material Materials::material(std::size_t index) {
    const Json& from = array_of(json_, "materials")[index];
    const std::string name = text_of(from, "name");
    const std::string shown =
        name.empty() ? fmt::format("material {}", index) : fmt::format("material '{}'", name);
    const Json* const glossy = find(object_of(from, "extensions"), "KHR_materials_pbrSpecularGlossiness");
    Material result =
        glossy != nullptr ? specular_glossiness(from, *glossy, shown) : metallic_roughness(from, shown);
    result.name = name;
    model_.note(
        "metallic-roughness materials become 'ggx' with highlights of the reflectance at normal "
        "incidence, which does not increase towards grazing angles");
    return result;
}

/// glTF 2.0, appendix B: a dielectric's diffuse and specular light, blended with a metal's.
Material Materials::metallic_roughness(const Json& from, const std::string& name) {
    const Json& pbr = object_of(from, "pbrMetallicRoughness");
    std::vector<double> base = factor_of(pbr, "baseColorFactor", 4);
    double metallic = std::clamp(number(pbr, "metallicFactor", 1), 0.0, 1.0);
    double roughness = std::clamp(number(pbr, "roughnessFactor", 1), 0.0, 1.0);
    const std::vector<double> dielectric = dielectric_of(from);
    Material result{.name = {}, .reflection = "ggx", .color = encoded(base)};
    std::vector<double> metal = base;
    MeasuredImage* image = nullptr;
    if (const Json* const info = find(pbr, "baseColorTexture")) {
        image = show(*info, name, result);
        for (std::size_t k = 0; image != nullptr && k < 3; ++k) metal[k] *= image->means.linear[k];
    }
    if (const Json* const info = find(pbr, "metallicRoughnessTexture")) {
        if (const MeasuredImage* const map = image_of(*info, name)) {
            roughness *= map->means.stored[1];
            metallic *= map->means.stored[2];
            model_.count("roughness maps", "only the mean of a texture of metalness and roughness is used",
                         "only the means of {} textures of metalness and roughness are used");
        }
    }
    if (result.image && metallic > 0.05)
        model_.count("tinted metals",
                     "the highlights of a textured metal have the mean colour of its texture",
                     "the highlights of {} textured metals have the mean colour of their textures");
    const double diffuse = (1 - metallic) * (1 - *std::ranges::max_element(dielectric));
    result.metal = {.share = metallic,
                    .color = {metal[0], metal[1], metal[2]},
                    .below = {dielectric[0], dielectric[1], dielectric[2]}};
    result.values = {{"ka", {rounded(diffuse + 0.5 * metallic)}},
                     {"kd", {rounded(diffuse)}},
                     {"ks", result.metal.highlights()},
                     {"roughness", alpha_of(roughness)},
                     {"ior", {100}}};
    cut_out(from, base[3], image, result);
    note_losses(from);
    return result;
}

Material Materials::specular_glossiness(const Json& from, const Json& extension, const std::string& name) {
    const std::vector<double> base = factor_of(extension, "diffuseFactor", 4);
    std::vector<double> specular = factor_of(extension, "specularFactor", 3);
    MeasuredImage* image = nullptr;
    double glossiness = std::clamp(number(extension, "glossinessFactor", 1), 0.0, 1.0);
    Material result{.name = {}, .reflection = "ggx", .color = encoded(base)};
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
    result.metal = {.share = 0, .color = {}, .below = {specular[0], specular[1], specular[2]}};
    result.values = {{"ka", {rounded(diffuse + 0.5 * (1 - diffuse))}},
                     {"kd", {rounded(diffuse)}},
                     {"ks", result.metal.highlights()},
                     {"roughness", alpha_of(1 - glossiness)},
                     {"ior", {100}}};
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
        constexpr std::array k_read = {"KHR_materials_ior", "KHR_materials_specular",
                                       "KHR_materials_pbrSpecularGlossiness"};
        if (std::ranges::find(k_read, name) != k_read.end()) continue;
        model_.count(name, fmt::format("the extension '{}' of a material is left out", name),
                     fmt::format("the extension '{}' of {{}} materials is left out", name));
    }
    const Json& specular = object_of(extensions, "KHR_materials_specular");
    for (const char* const map : {"specularTexture", "specularColorTexture"})
        if (specular.contains(map))
            model_.count("specular maps",
                         "a texture of specular reflectance is left out; its factor applies everywhere",
                         "{} textures of specular reflectance are left out; their factors apply everywhere");
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
