#include "import/gltf_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

import candela.api;
import candela.util;

namespace importing::gltf {

namespace {

const Json* transform_of(const Json& info) {
    return find(object_of(info, "extensions"), "KHR_texture_transform");
}

/// KHR_texture_transform scales, rotates and moves coordinates whose v points downwards, in a scene it points
/// upwards.
Placing placing_of(const Json& transform) {
    constexpr double k_most = 1e6;
    const auto pair = [&](const char* key, double otherwise) {
        std::vector<double> values = numbers(transform, key, 2);
        if (values.empty()) values.assign(2, otherwise);
        for (double& x : values) x = std::clamp(x, -k_most, k_most);
        return values;
    };
    const std::vector<double> scale = pair("scale", 1), offset = pair("offset", 0);
    const double turns = number(transform, "rotation", 0) / (2 * std::numbers::pi);
    const double angle = 2 * std::numbers::pi * std::remainder(turns, 1);
    const auto rounded = [](double x) { return std::round(1e6 * x) / 1e6 + 0.0; };
    return {.scale = {scale[0], scale[1]},
            .rotation = rounded(angle * 180 / std::numbers::pi),
            .offset = {rounded(offset[0] + std::sin(angle) * scale[1]),
                       rounded(1 - offset[1] - std::cos(angle) * scale[1])}};
}

const char* name_of(Channel channel) {
    switch (channel) {
        case Channel::green:
            return "g";
        case Channel::blue:
            return "b";
        case Channel::alpha:
            return "a";
        case Channel::rgb:
            return "";
        default:
            return "r";
    }
}

/// Adds the numbers of the textures that a part of a material names: "baseColorTexture": { "index": 3 }.
void add_textures(const Json& part, std::set<std::size_t>& textures) {
    if (!part.is_structured()) return;
    if (part.is_object()) {
        if (const auto index = index_of(part, "index")) textures.insert(*index);
    }
    for (const Json& inner : part) add_textures(inner, textures);
}

}  // namespace

Textures::Textures(Container& container, candela::Registry& registry, Model& model)
    : container_(container), json_(container.json()), registry_(registry), model_(model) {
    read_all();
}

std::optional<Textures::Placed> Textures::texture(const Json& from, const char* name,
                                                  const std::string& material) {
    const Json* const info = find(from, name);
    if (info == nullptr) return std::nullopt;
    const Json* const transform = transform_of(*info);
    std::optional<std::size_t> set = index_of(*info, "texCoord");
    if (transform != nullptr && find(*transform, "texCoord") != nullptr)
        set = index_of(*transform, "texCoord");
    const std::size_t number = set.value_or(0);
    if (number > 1 || (number == 1 && !has_second_uv())) {
        model_.count("texture coordinates", "a texture on a further set of texture coordinates is left out",
                     "{} textures on further sets of texture coordinates are left out");
        return std::nullopt;
    }
    MeasuredImage* const image = image_of(*info, material);
    if (image == nullptr) return std::nullopt;
    Placed placed{.image = image, .placing = transform != nullptr ? placing_of(*transform) : Placing{}};
    wrap(*info, placed.placing);
    placed.placing.uv = static_cast<int>(number);
    return placed;
}

bool Textures::has_second_uv() const {
    for (const Json& mesh : array_of(json_, "meshes"))
        for (const Json& primitive : array_of(mesh, "primitives"))
            if (find(object_of(primitive, "attributes"), "TEXCOORD_1") != nullptr) return true;
    return false;
}

void Textures::show(const Json& from, const char* name, const std::string& material,
                    std::vector<double> factor, Material& to) {
    const auto placed = texture(from, name, material);
    if (!placed) return;
    factor.resize(3);
    to.color_map = ParameterMap{.parameter = "color",
                                .image = index_of_image(*placed->image),
                                .scale = shortened(std::move(factor)),
                                .placing = placed->placing};
}

std::vector<double> Textures::map(const Placed& picture, Channel channel, const char* parameter,
                                  std::vector<double> scale, std::vector<double> offset, Material& to) {
    MeasuredImage& image = *picture.image;
    const Means& means = image.means;
    std::vector<double> mean;
    bool is_constant = std::ranges::all_of(scale, [](double x) { return x == 0; });
    if (channel == Channel::rgb) {
        for (std::size_t k = 0; k < 3; ++k)
            mean.push_back(offset[std::min(k, offset.size() - 1)] +
                           scale[std::min(k, scale.size() - 1)] * means.linear[k]);
        is_constant |= std::ranges::all_of(means.are_equal, [](bool are_equal) { return are_equal; });
    } else if (channel == Channel::alpha) {
        mean = {offset[0] + scale[0] * means.opacity};
        is_constant |= means.is_opacity_equal;
    } else {
        const auto k = static_cast<std::size_t>(channel);
        mean = {offset[0] + scale[0] * means.stored[k]};
        is_constant |= means.are_equal[k];
    }
    if (!is_constant)
        to.maps.push_back({.parameter = parameter,
                           .image = index_of_image(image),
                           .channel = name_of(channel),
                           .scale = shortened(std::move(scale)),
                           .offset = shortened(std::move(offset)),
                           .placing = picture.placing});
    return mean;
}

void Textures::tilt_normals(const Json& material, const std::string& name, Material& to) {
    const auto picture = texture(material, "normalTexture", name);
    if (!picture) return;
    constexpr double k_steepest = 1e3;
    const double scale = number(*find(material, "normalTexture"), "scale", 1);
    to.normals = ParameterMap{.parameter = {},
                              .image = index_of_image(*picture->image),
                              .scale = shortened({std::clamp(scale, -k_steepest, k_steepest)}),
                              .placing = picture->placing};
}

void Textures::wrap(const Json& info, Placing& to) const {
    const Json& texture = *element(array_of(json_, "textures"), index_of(info, "index"));
    const Json* const sampler = element(array_of(json_, "samplers"), index_of(texture, "sampler"));
    if (sampler == nullptr) return;
    const auto word = [&](const char* key) {
        switch (index_of(*sampler, key).value_or(0)) {
            case 33071:
                return "clamp";
            case 33648:
                return "mirror";
            default:
                return "repeat";
        }
    };
    to.wrap = word("wrapS");
    to.wrap_v = word("wrapT");
}

std::size_t Textures::index_of_image(MeasuredImage& image) {
    if (!image.index) {
        image.index = model_.images.size();
        model_.images.push_back(image.file);
    }
    return *image.index;
}

std::optional<std::size_t> Textures::source_of(const Json& texture) {
    std::optional<std::size_t> source = index_of(texture, "source");
    // Given two formats, prefer the one that every program reads.
    for (const char* const extension :
         {"EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds", "KHR_texture_basisu"})
        if (!source) source = index_of(object_of(object_of(texture, "extensions"), extension), "source");
    return source;
}

Textures::MeasuredImage* Textures::image_of(const Json& info, const std::string& material) {
    const Json* const texture = element(array_of(json_, "textures"), index_of(info, "index"));
    const auto source = texture != nullptr ? source_of(*texture) : std::nullopt;
    if (!source || element(array_of(json_, "images"), source) == nullptr) {
        model_.count("no textures", fmt::format("the picture of a texture of {} is missing", material),
                     fmt::format("the pictures of {{}} textures are missing, the first of {}", material));
        return nullptr;
    }
    return image_at(*source, material);
}

Textures::ReadPicture Textures::read(Image file) const {
    ReadPicture result;
    try {
        ReadImage read = read_image(file, registry_);
        file.brightness = brightness_of(read.pixels);
        result.other_format = std::move(read.other_format);
        result.image = MeasuredImage{.file = std::move(file), .means = means_of(read.pixels)};
    } catch (const candela::MemoryShortage&) {
        throw;
    } catch (const candela::Error& problem) {
        result.problem = problem.what();
    }
    return result;
}

Textures::ReadPicture Textures::read(std::size_t image) {
    try {
        return read(container_.image(image));
    } catch (const candela::Error& problem) {
        return {.problem = problem.what()};
    }
}

void Textures::read_all() {
    std::set<std::size_t> textures, images;
    for (const Json& material : array_of(json_, "materials")) add_textures(material, textures);
    for (const std::size_t texture : textures) {
        const Json* const named = element(array_of(json_, "textures"), texture);
        const auto source = named != nullptr ? source_of(*named) : std::nullopt;
        if (element(array_of(json_, "images"), source) != nullptr) images.insert(*source);
    }
    std::vector<std::pair<std::size_t, Image>> files;
    for (const std::size_t image : images) {
        try {
            files.emplace_back(image, container_.image(image));
        } catch (const candela::Error& problem) {
            images_[image].problem = problem.what();
        }
    }
    std::vector<std::optional<ReadPicture>> pictures(files.size());
    const auto read_some = [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            try {
                pictures[i] = read(std::move(files[i].second));
            } catch (const candela::MemoryShortage&) {
                continue;  // alone, it may have enough
            }
        }
    };
    if (files.size() == 1) {
        read_some(0, 1);
    } else {
        // One thread each: while waiting for others, it would begin with further pictures.
        candela::parallel_for(files.size(), 1, [&](std::size_t begin, std::size_t end) {
            candela::with_threads(1, [&] { read_some(begin, end); });
        });
    }
    for (std::size_t i = 0; i < files.size(); ++i)
        if (pictures[i]) images_[files[i].first] = *std::move(pictures[i]);
}

Textures::MeasuredImage* Textures::image_at(std::size_t index, const std::string& material) {
    const auto [known, is_new] = images_.try_emplace(index);
    ReadPicture& picture = known->second;
    if (is_new) picture = read(index);
    if (!std::exchange(picture.is_noted, true)) {
        if (!picture.problem.empty())
            model_.count(
                "pictures", fmt::format("a texture of {} is left out: {}", material, picture.problem),
                fmt::format("{{}} textures are left out, the first of {}: {}", material, picture.problem));
        if (!picture.other_format.empty())
            model_.count("misnamed pictures",
                         fmt::format("a texture of {} is read as {}, according to its content", material,
                                     picture.other_format),
                         fmt::format("{{}} textures are read according to their content, the first "
                                     "of {} as {}",
                                     material, picture.other_format));
    }
    return picture.image ? &*picture.image : nullptr;
}

}  // namespace importing::gltf
