#include "vertex_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <iterator>
#include <map>
#include <numbers>
#include <numeric>
#include <span>
#include <string_view>

#include "candela/color.h"
#include "candela/target/arrays.h"
#include "candela/target/textures.h"

namespace candela::gltf_target {

namespace {

using target::is_of_vertices;

/// The name of an attribute: _ROUGHNESS.
std::string attribute_name(std::string_view parameter) {
    std::string name = "_";
    for (const char c : parameter) name += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    return name;
}

bool are_of_vertices(std::span<const ExportedTexturedNumber> numbers) {
    return !numbers.empty() && is_of_vertices(numbers.front());
}

std::vector<ExportedTexturedNumber> pictures_among(std::span<const ExportedTexturedNumber> numbers) {
    std::vector<ExportedTexturedNumber> result;
    std::ranges::remove_copy_if(numbers, std::back_inserter(result), is_of_vertices);
    return result;
}

}  // namespace

VertexNumbers::VertexNumbers(const ExportedScene& scene, const ExportedObject& object,
                             const ExportedMesh& mesh, FileSink& files)
    : scene_(scene), object_(object), mesh_(mesh), files_(files), rest_(object) {
    take_colors();
    take_opacity();
    take_parameters();
    take_common();
}

std::vector<float> VertexNumbers::values_of(const ExportedTexturedNumber& number, const char* of) const {
    std::vector<float> values;
    values.reserve(mesh_.vertex_count);
    bool is_clamped = false;
    for (const float given : mesh_.channels[number.vertex_channel]) {
        values.push_back(target::value_of(number, given));
        is_clamped = is_clamped || values.back() != number.offset + number.scale * given;
    }
    if (is_clamped && of != nullptr)
        files_.approximate(fmt::format("{} of object {} is brought into its range at vertices, not at points",
                                       of, object_.label)
                               .c_str());
    return values;
}

void VertexNumbers::take_colors() {
    if (!are_of_vertices(object_.color_numbers)) return;
    rest_.color_numbers = {};
    colors_.assign(4 * mesh_.vertex_count, 1);
    for (const ExportedTexturedNumber& number : object_.color_numbers) {
        const std::vector<float> values = values_of(number, "the colour");
        for (std::size_t i = 0; i < values.size(); ++i) colors_[4 * i + number.channel] = values[i];
    }
    if (!mesh_.color) return;
    files_.approximate(
        fmt::format("the product of two colours at the vertices of object {} is interpolated between them",
                    object_.label)
            .c_str());
    for (std::size_t i = 0; i < mesh_.vertex_count; ++i) {
        const Vec3 color = mesh_.color[i];
        for (std::size_t c = 0; c < 3; ++c) colors_[4 * i + c] *= std::array{color.x, color.y, color.z}[c];
    }
}

void VertexNumbers::take_opacity() {
    std::vector<ExportedTexturedNumber> of_vertices;
    std::ranges::copy_if(object_.opacity_numbers, std::back_inserter(of_vertices), is_of_vertices);
    if (of_vertices.empty()) return;
    opacity_numbers_ = pictures_among(object_.opacity_numbers);
    rest_.opacity_numbers = opacity_numbers_;
    rest_.opacity = 1;
    if (of_vertices.size() > 1)
        files_.approximate(
            fmt::format("the product of numbers at the vertices of object {} is interpolated between them",
                        object_.label)
                .c_str());
    if (colors_.empty()) {
        colors_.assign(4 * mesh_.vertex_count, 1);
        for (std::size_t i = 0; mesh_.color && i < mesh_.vertex_count; ++i) {
            const Vec3 color = mesh_.color[i];
            std::ranges::copy(std::array{color.x, color.y, color.z},
                              colors_.begin() + static_cast<std::ptrdiff_t>(4 * i));
        }
    }
    alpha_ = 1;
    for (ExportedTexturedNumber& number : of_vertices) {
        // The material's alpha has a factor, so that the vertices' are the file's own.
        if (number.offset == 0 && number.scale > 0 && number.scale <= 1) {
            *alpha_ *= number.scale;
            number.scale = 1;
        }
        const std::vector<float> values = values_of(number, "the opacity");
        for (std::size_t i = 0; i < values.size(); ++i) colors_[4 * i + 3] *= values[i];
    }
}

std::vector<float> VertexNumbers::named(const std::string& parameter, const Numbers& numbers, float unit) {
    const std::string name = attribute_name(parameter);
    files_.approximate(fmt::format("the numbers of vertices that give '{}' of object {} become the attribute "
                                   "{}, and their mean its value",
                                   parameter, object_.label, name)
                           .c_str());
    std::vector<float> means, all(numbers.size() * mesh_.vertex_count);
    for (std::size_t k = 0; k < numbers.size(); ++k) {
        const std::vector<float> values = values_of(numbers[k], nullptr);
        means.push_back(std::accumulate(values.begin(), values.end(), 0.0f) /
                        static_cast<float>(std::max<std::size_t>(values.size(), 1)));
        for (std::size_t i = 0; i < values.size(); ++i) all[numbers.size() * i + k] = unit * values[i];
    }
    attributes_.emplace_back(name, std::move(all));
    return means;
}

void VertexNumbers::take_parameters() {
    model_numbers_ = pictures_among(object_.textured_numbers);
    if (model_numbers_.size() == object_.textured_numbers.size()) return;
    rest_.textured_numbers = model_numbers_;
    const ExportedReflection& model = scene_.reflections[object_.reflection];
    materials_.assign(object_.materials.begin(), object_.materials.end());
    const std::span<const ParamValue> own = materials_[object_.reflection].runtime;
    values_.assign(own.begin(), own.end());
    std::map<std::size_t, Numbers> by_parameter;
    for (const ExportedTexturedNumber& number : object_.textured_numbers)
        if (is_of_vertices(number)) by_parameter[number.parameter].push_back(number);
    for (const auto& [parameter, numbers] : by_parameter) {
        const auto& declared = model.plugin->parameters[parameter];
        const bool is_angle = std::string_view(declared.unit) == "deg";
        const std::vector<float> means =
            named(declared.name, numbers, is_angle ? 180 / std::numbers::pi_v<float> : 1.0f);
        for (std::size_t k = 0; k < means.size(); ++k)
            values_[parameter].number[numbers[k].channel] = means[k];
    }
    materials_[object_.reflection].runtime = values_;
    rest_.materials = materials_;
}

void VertexNumbers::take_common() {
    if (are_of_vertices(object_.emission_numbers)) {
        const Numbers numbers(object_.emission_numbers.begin(), object_.emission_numbers.end());
        std::vector<float> means = named("emission", numbers, 1);
        for (float& mean : means)
            mean = 255 * (scene_.image.color_management == ColorEncoding::srgb ? linear_to_srgb(mean) : mean);
        rest_.emission = {means[0], means[1], means[2]};
        rest_.emission_numbers = {};
    }
    if (are_of_vertices(object_.occlusion_numbers)) {
        rest_.occlusion = named("occlusion", {object_.occlusion_numbers.front()}, 1).front();
        rest_.occlusion_numbers = {};
    }
}

void VertexNumbers::add_to(Json& attributes, Document& document) const {
    if (alpha_) {
        attributes["COLOR_0"] = document.add_floats(colors_, 4);
    } else if (!colors_.empty()) {
        std::vector<float> rgb;
        for (std::size_t i = 0; i < colors_.size(); ++i)
            if (i % 4 != 3) rgb.push_back(colors_[i]);
        attributes["COLOR_0"] = document.add_floats(rgb, 3);
    } else if (mesh_.color) {
        attributes["COLOR_0"] = document.add_vectors(mesh_.color, mesh_.vertex_count);
    }
    for (const auto& [name, values] : attributes_)
        attributes[name] = document.add_floats(values, values.size() / mesh_.vertex_count);
}

}  // namespace candela::gltf_target
