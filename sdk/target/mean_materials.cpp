#include "candela/target/mean_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/color.h"
#include "candela/target/textures.h"

namespace candela::target {

float mean_of(const ExportedScene& scene, const ExportedTexturedNumber& number) {
    const std::span<const std::uint16_t> texels = scene.textures[number.texture].levels.front().texels;
    double sum = 0;
    for (std::size_t i = number.texel_channel; i < texels.size(); i += 3)
        sum += double{value_of(number, static_cast<float>(texels[i]) / 65535.0f)};
    return static_cast<float>(sum / (static_cast<double>(texels.size()) / 3));
}

std::vector<ParamValue> mean_values(const ExportedScene& scene, const ExportedObject& object) {
    const std::span<const ParamValue> own = object.materials[object.reflection].runtime;
    std::vector<ParamValue> values(own.begin(), own.end());
    for (const ExportedTexturedNumber& number : object.textured_numbers)
        values[number.parameter].number[number.channel] = mean_of(scene, number);
    return values;
}

namespace {

/// The colour, as written, that becomes this intensity.
float written(float intensity, ColorEncoding encoding) {
    return 255 * (encoding == ColorEncoding::srgb ? linear_to_srgb(intensity) : intensity);
}

/// Reports that what gives a key of the material becomes its mean.
void approximate_by_mean(const ExportedObject& object, const char* key, FileSink& files,
                         bool is_vertices = false) {
    files.approximate(
        (is_vertices ? fmt::format("the numbers of vertices that give '{}' of object {} become their mean",
                                   key, object.label)
                     : fmt::format("the texture of '{}' of object {} becomes its mean", key, object.label))
            .c_str());
}

}  // namespace

void approximate_by_mean(const ExportedScene& scene, const ExportedObject& object, std::size_t parameter,
                         FileSink& files) {
    approximate_by_mean(object, scene.reflections[object.reflection].plugin->parameters[parameter].name,
                        files);
}

float MeanMaterials::mean(const ExportedTexturedNumber& number, std::size_t object) const {
    if (!is_of_vertices(number)) return mean_of(scene_, number);
    const ExportedMesh mesh = scene_.geometry->in_world_space(object);
    double sum = 0;
    for (const float given : mesh.channels[number.vertex_channel]) sum += double{value_of(number, given)};
    return static_cast<float>(sum / static_cast<double>(std::max<std::size_t>(mesh.vertex_count, 1)));
}

void MeanMaterials::take_common(ExportedObject& object, std::size_t index, FileSink& files) const {
    if (!object.emission_numbers.empty()) {
        approximate_by_mean(object, "emission", files, is_of_vertices(object.emission_numbers.front()));
        const auto channel = [&](std::size_t c) {
            return written(mean(object.emission_numbers[c], index), scene_.image.color_management);
        };
        object.emission = {channel(0), channel(1), channel(2)};
        object.emission_numbers = {};
    }
    if (!object.occlusion_numbers.empty()) {
        const ExportedTexturedNumber& number = object.occlusion_numbers.front();
        approximate_by_mean(object, "occlusion", files, is_of_vertices(number));
        object.occlusion = mean(number, index);
        object.occlusion_numbers = {};
    }
}

MeanMaterials::MeanMaterials(const ExportedScene& scene, FileSink& files)
    : scene_(scene), objects_(scene.objects.begin(), scene.objects.end()) {
    materials_.reserve(objects_.size());
    values_.reserve(objects_.size());
    for (std::size_t i = 0; i < objects_.size(); ++i) {
        ExportedObject& object = objects_[i];
        take_common(object, i, files);
        if (object.textured_numbers.empty()) continue;
        auto& materials = materials_.emplace_back(object.materials.begin(), object.materials.end());
        const std::span<const ParamValue> own = materials[object.reflection].runtime;
        std::vector<ParamValue>& values = values_.emplace_back(own.begin(), own.end());
        for (const ExportedTexturedNumber& number : object.textured_numbers) {
            approximate_by_mean(
                object, scene.reflections[object.reflection].plugin->parameters[number.parameter].name, files,
                is_of_vertices(number));
            values[number.parameter].number[number.channel] = mean(number, i);
        }
        materials[object.reflection].runtime = values;
        object.materials = materials;
        object.textured_numbers = {};
    }
    scene_.objects = objects_;
}

}  // namespace candela::target
