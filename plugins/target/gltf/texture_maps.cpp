#include "texture_maps.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string_view>
#include <utility>

#include "candela/color.h"
#include "candela/target/mean_materials.h"
#include "candela/target/textures.h"

namespace candela::gltf_target {

/// A channel of a map, 0 to 3, and the channel of a parameter that it gives: factor * texel, or one minus
/// that.
struct TextureMaps::Channel {
    const char* parameter;
    std::size_t of_parameter;
    std::size_t of_map;
    const char* factor;
    bool is_inverted = false;
};

struct TextureMaps::Map {
    const char* model;
    const char* extension;  // null: pbrMetallicRoughness
    const char* name;
    bool is_encoded;  // like colours
    float most;       // the largest factor
    std::span<const Channel> channels;
    const char* minimum = nullptr;  // the factor of black, if there is one
    bool has_direction = false;     // in red and green, which stay that of the tangent
    bool has_factor = true;         // otherwise the picture has the values themselves
};

namespace {

using Channel = TextureMaps::Channel;
constexpr float k_any = std::numeric_limits<float>::max();
constexpr const char *k_model = "reflection/metallic-roughness", *k_glossy = "reflection/specular-glossiness",
                     *k_coat = "KHR_materials_clearcoat", *k_sheen = "KHR_materials_sheen",
                     *k_grain = "KHR_materials_anisotropy", *k_film = "KHR_materials_iridescence";

constexpr Channel k_metallic_roughness[] = {{"roughness", 0, 1, "roughnessFactor"},
                                            {"metallic", 0, 2, "metallicFactor"}};
constexpr Channel k_gloss[] = {{"glossiness", 0, 1, "roughnessFactor", true}};
constexpr Channel k_specular_strength[] = {{"specular", 0, 3, "specularFactor"}};
constexpr Channel k_specular_color[] = {{"specular_color", 0, 0, "specularColorFactor"},
                                        {"specular_color", 1, 1, "specularColorFactor"},
                                        {"specular_color", 2, 2, "specularColorFactor"}};
constexpr Channel k_coat_strength[] = {{"clearcoat", 0, 0, "clearcoatFactor"}};
constexpr Channel k_coat_roughness[] = {{"clearcoat_roughness", 0, 1, "clearcoatRoughnessFactor"}};
constexpr Channel k_sheen_color[] = {{"sheen_color", 0, 0, "sheenColorFactor"},
                                     {"sheen_color", 1, 1, "sheenColorFactor"},
                                     {"sheen_color", 2, 2, "sheenColorFactor"}};
constexpr Channel k_sheen_roughness[] = {{"sheen_roughness", 0, 3, "sheenRoughnessFactor"}};
constexpr Channel k_grain_strength[] = {{"anisotropy_strength", 0, 2, "anisotropyStrength"}};
constexpr Channel k_film_share[] = {{"iridescence", 0, 0, "iridescenceFactor"}};
constexpr Channel k_film_thickness[] = {{"iridescence_thickness", 0, 1, "iridescenceThicknessMaximum"}};

constexpr TextureMaps::Map k_maps[] = {
    {k_model, nullptr, "metallicRoughnessTexture", false, 1, k_metallic_roughness},
    {k_model, k_specular, "specularTexture", false, 1, k_specular_strength},
    {k_model, k_specular, "specularColorTexture", true, k_any, k_specular_color},
    {k_model, k_coat, "clearcoatTexture", false, 1, k_coat_strength},
    {k_model, k_coat, "clearcoatRoughnessTexture", false, 1, k_coat_roughness},
    {k_model, k_sheen, "sheenColorTexture", true, 1, k_sheen_color},
    {k_model, k_sheen, "sheenRoughnessTexture", false, 1, k_sheen_roughness},
    {k_model, k_grain, "anisotropyTexture", false, 1, k_grain_strength, nullptr, true},
    {k_model, k_film, "iridescenceTexture", false, 1, k_film_share},
    {k_model, k_film, "iridescenceThicknessTexture", false, k_any, k_film_thickness,
     "iridescenceThicknessMinimum"},
    {k_glossy, nullptr, "metallicRoughnessTexture", false, 1, k_gloss},
    {k_glossy, k_specular, "specularColorTexture", true, 1, k_specular_color},
};

constexpr Channel k_color[] = {{"color", 0, 0, "baseColorFactor"},
                               {"color", 1, 1, "baseColorFactor"},
                               {"color", 2, 2, "baseColorFactor"},
                               {"opacity", 0, 3, "baseColorFactor"}};
constexpr Channel k_emission[] = {{"emission", 0, 0, "emissiveFactor"},
                                  {"emission", 1, 1, "emissiveFactor"},
                                  {"emission", 2, 2, "emissiveFactor"}};
constexpr Channel k_occlusion[] = {{"occlusion", 0, 0, nullptr}};
constexpr TextureMaps::Map k_color_map{nullptr, nullptr, "baseColorTexture", true, 1, k_color};
constexpr TextureMaps::Map k_emission_map{nullptr, nullptr, "emissiveTexture", true, 1, k_emission};
constexpr TextureMaps::Map k_occlusion_map{
    nullptr, nullptr, "occlusionTexture", false, 1, k_occlusion, nullptr, false, false};

/// glTF's transform, whose v points downwards, of one whose v points upwards: (u, v) are scaled, rotated and
/// moved in both. Nothing for the identity.
std::optional<Json> transform_json(const float (&placing)[6]) {
    if (std::ranges::equal(placing, std::array<float, 6>{1, 0, 0, 0, 1, 0})) return std::nullopt;
    double m[6];
    std::ranges::copy(placing, m);
    // Of a scale of zero, the other column has the angle.
    const double width = std::hypot(m[0], m[3]);
    const double angle = width > 0 ? std::atan2(m[3], m[0]) : std::atan2(-m[1], m[4]);
    const double c = std::cos(angle), s = std::sin(angle);
    const double height = c * m[4] - s * m[1];
    const auto rounded = [](double x) { return static_cast<float>(std::round(1e7 * x) / 1e7); };
    return Json{{"offset", {rounded(m[2] - s * height), rounded(1 - c * height - m[5])}},
                {"rotation", rounded(angle)},
                {"scale", {rounded(width), rounded(height)}}};
}

bool is_placed_like(const ExportedTexturedNumber& a, const ExportedTexturedNumber& b) {
    return std::ranges::equal(a.wrap, b.wrap) && a.uv == b.uv && std::ranges::equal(a.placing, b.placing);
}

/// A level between its texels, as if it had another size.
float texel_at(const ExportedTextureLevel& level, std::size_t channel, double u, double v) {
    const auto side = [](double at, int size) {
        const double x = std::clamp(at * size - 0.5, 0.0, static_cast<double>(size - 1));
        const int low = static_cast<int>(x);
        return std::pair(low, x - low);
    };
    const auto [x, right] = side(u, level.width);
    const auto [y, below] = side(v, level.height);
    const auto texel = [&](int column, int row) {
        const int at = std::min(row, level.height - 1) * level.width + std::min(column, level.width - 1);
        return static_cast<double>(level.texels[3 * static_cast<std::size_t>(at) + channel]);
    };
    const double sum = (1 - below) * ((1 - right) * texel(x, y) + right * texel(x + 1, y)) +
                       below * ((1 - right) * texel(x, y + 1) + right * texel(x + 1, y + 1));
    return static_cast<float>(sum / 65535);
}

/// Whether red and green are the tangent's direction.
bool is_along_tangent(const ExportedTextureLevel& level) {
    for (std::size_t i = 0; i < level.texels.size(); i += 3) {
        const int red = level.texels[i] / 257, green = level.texels[i + 1] / 257;
        if (red != 255 || green < 127 || green > 128) return false;
    }
    return true;
}

/// The channel of the file from which a number comes, 0 to 3.
std::size_t channel_in_file(const ExportedScene& scene, const ExportedTexturedNumber& number) {
    return scene.textures[number.texture].is_opacity ? 3 : number.texel_channel;
}

void set_factor(Json& to, const Channel& channel, std::size_t count, float factor) {
    if (count == 1) {
        to[channel.factor] = factor;
        return;
    }
    if (!to.contains(channel.factor)) to[channel.factor] = {1, 1, 1};
    to[channel.factor][channel.of_parameter] = factor;
}

}  // namespace

float TextureMaps::Source::value(float texel) const {
    const float x =
        std::min(std::max(number->offset + number->scale * texel, number->minimum), number->maximum);
    return channel->is_inverted ? 1 - x : x;
}

void TextureMaps::add(const ExportedObject& object, std::span<const ParamValue> values, Json& material) {
    if (object.textured_numbers.empty()) return;
    const ExportedReflection& model = scene_.reflections[object.reflection];
    const auto name_of = [&](std::size_t parameter) {
        return std::string_view(model.plugin->parameters[parameter].name);
    };
    // glTF has no ambient coefficient, either.
    std::vector<std::string_view> known{"ka"};
    for (const Map& map : k_maps) {
        if (std::string_view(model.id) != map.model) continue;
        std::vector<Source> sources;
        for (const Channel& channel : map.channels) {
            known.emplace_back(channel.parameter);
            Source source{.channel = &channel};
            while (name_of(source.parameter) != channel.parameter) ++source.parameter;
            source.mean = values[source.parameter].number[channel.of_parameter];
            for (const ExportedTexturedNumber& number : object.textured_numbers)
                if (number.parameter == source.parameter && number.channel == channel.of_parameter)
                    source.number = &number;
            sources.push_back(source);
        }
        // Without coat, sheen, grain or film, the rest of it does not matter.
        const bool has_effect =
            map.extension == nullptr || std::string_view(map.extension) == k_specular ||
            (material.contains("extensions") && material["extensions"].contains(map.extension));
        if (has_effect) add(object, map, std::move(sources), material);
    }
    for (const ExportedTexturedNumber& number : object.textured_numbers)
        if (std::ranges::find(known, name_of(number.parameter)) == known.end())
            target::approximate_by_mean(scene_, object, number.parameter, files_);
}

void TextureMaps::add(const ExportedObject& object, const Map& map, std::vector<Source> sources,
                      Json& material) {
    const auto first =
        std::ranges::find_if(sources, [](const Source& source) { return source.number != nullptr; });
    if (first == sources.end()) return;
    for (Source& source : sources) {
        if (source.number == nullptr || is_placed_like(*source.number, *first->number)) continue;
        target::approximate_by_mean(scene_, object, source.parameter, files_);
        source.number = nullptr;
    }
    auto picture = file_of(map, sources);
    if (!picture) picture = baked(map, sources);
    Json& to =
        map.extension == nullptr ? material["pbrMetallicRoughness"] : material["extensions"][map.extension];
    if (map.extension != nullptr) document_.use_extension(map.extension);
    for (std::size_t i = 0; i < sources.size(); ++i) {
        if (sources[i].number == nullptr) continue;
        set_factor(to, *sources[i].channel, sources.size() == 3 ? 3 : 1, picture->highest[i]);
        if (map.minimum != nullptr) to[map.minimum] = picture->lowest[i];
    }
    to[map.name] = info_of(picture->image, *first->number);
}

template <class Reader>
Json TextureMaps::info_of(std::size_t image, const Reader& reader) {
    Json info = {{"index", pictures_.texture_of(image, reader.wrap)}};
    if (reader.uv != 0) info["texCoord"] = reader.uv;
    if (auto transform = transform_json(reader.placing)) {
        info["extensions"]["KHR_texture_transform"] = std::move(*transform);
        document_.use_extension("KHR_texture_transform");
    }
    return info;
}

void TextureMaps::add_color(const ExportedObject& object, const std::optional<float>& vertex_alpha,
                            Json& material) {
    const bool is_see_through = object.is_see_through() || vertex_alpha;
    if (is_see_through) {
        material["alphaMode"] = object.opacity_cutoff > 0 ? "MASK" : "BLEND";
        if (object.opacity_cutoff > 0) material["alphaCutoff"] = object.opacity_cutoff;
    }
    Json& pbr = material["pbrMetallicRoughness"];
    const float of_vertices = vertex_alpha.value_or(1);
    if (is_see_through) pbr["baseColorFactor"][3] = of_vertices * object.opacity;
    const auto opacity = is_see_through ? object.opacity_numbers : std::span<const ExportedTexturedNumber>();
    const std::span<const ExportedTexturedNumber> color = object.color_numbers;
    if (color.empty() && opacity.empty()) return;
    const ExportedTexturedNumber& placed = color.empty() ? opacity.front() : color.front();
    std::vector<Source> sources;
    for (std::size_t c = 0; c < 3; ++c)
        sources.push_back({.channel = &k_color[c], .number = color.empty() ? nullptr : &color[c], .mean = 1});
    if (!opacity.empty()) {
        if (opacity.size() > 1)
            files_.approximate(
                fmt::format("the opacity of object {}, which is a product, has its first texture only",
                            object.label)
                    .c_str());
        if (!is_placed_like(opacity.front(), placed))
            files_.approximate(
                fmt::format("the opacity of object {} is placed like its colour", object.label).c_str());
        sources.push_back({.channel = &k_color[3], .number = &opacity.front()});
    }
    const auto file = file_of(k_color_map, sources);
    const Picture picture = file ? *file : baked(k_color_map, sources);
    for (std::size_t c = 0; c < 3 && !color.empty(); ++c)
        pbr["baseColorFactor"][c] = picture.highest[c] * pbr["baseColorFactor"][c].get<float>();
    if (!opacity.empty()) pbr["baseColorFactor"][3] = of_vertices * picture.highest[3];
    pbr["baseColorTexture"] = info_of(picture.image, placed);
}

void TextureMaps::add_emission(const ExportedObject& object, Json& material) {
    const Rgb emission = target::emission_of(object, scene_.image.color_management);
    if (emission == Rgb{}) return;
    std::array<float, 3> factor{emission.r, emission.g, emission.b};
    if (!object.emission_numbers.empty()) {
        std::vector<Source> sources;
        for (std::size_t c = 0; c < 3; ++c)
            sources.push_back({.channel = &k_emission[c], .number = &object.emission_numbers[c]});
        const auto file = file_of(k_emission_map, sources);
        const Picture picture = file ? *file : baked(k_emission_map, sources);
        for (std::size_t c = 0; c < 3; ++c) factor[c] *= picture.highest[c];
        const ExportedTexturedNumber& placed = object.emission_numbers.front();
        material["emissiveTexture"] = info_of(picture.image, placed);
    }
    const float strength = std::max(*std::ranges::max_element(factor), 1.0f);
    material["emissiveFactor"] = {factor[0] / strength, factor[1] / strength, factor[2] / strength};
    if (strength == 1) return;
    material["extensions"]["KHR_materials_emissive_strength"]["emissiveStrength"] = strength;
    document_.use_extension("KHR_materials_emissive_strength");
}

void TextureMaps::add_occlusion(const ExportedObject& object, Json& material) {
    if (object.occlusion_numbers.empty()) {
        if (object.occlusion != 1)
            files_.approximate(
                fmt::format("the occlusion of object {}, which has no texture, is left out", object.label)
                    .c_str());
        return;
    }
    const ExportedTexturedNumber& number = object.occlusion_numbers.front();
    const std::vector<Source> sources{{.channel = &k_occlusion[0], .number = &number}};
    constexpr float k_rounding = 1e-4f;
    const bool is_strength = channel_in_file(scene_, number) == 0 && number.scale > 0 && number.scale <= 1 &&
                             std::abs(number.offset + number.scale - 1) < k_rounding;
    const auto file = is_strength ? pictures_.file_of(number.texture, false) : std::nullopt;
    const std::size_t image = file ? *file : baked(k_occlusion_map, sources).image;
    material["occlusionTexture"] = info_of(image, number);
    if (file && number.scale != 1) material["occlusionTexture"]["strength"] = number.scale;
}

void TextureMaps::add_normals(const ExportedObject& object, Json& material) {
    if (object.normal_map == nullptr) return;
    const ExportedNormalMap& map = *object.normal_map;
    if (map.has_slopes) {
        files_.approximate(fmt::format("the bump map of object {} is left out", object.label).c_str());
        return;
    }
    auto image = pictures_.file_of(map.texture, false);
    if (!image) {
        const ExportedTextureLevel& level = scene_.textures[map.texture].levels.front();
        std::vector<std::uint8_t> bytes;
        bytes.reserve(level.texels.size());
        for (const int channel : level.texels)
            bytes.push_back(static_cast<std::uint8_t>((channel + 128) / 257));
        image = pictures_.add(png_of(level.width, level.height, 3, bytes), "image/png");
    }
    material["normalTexture"] = info_of(*image, map);
    if (map.scale != 1) material["normalTexture"]["scale"] = map.scale;
}

std::optional<TextureMaps::Picture> TextureMaps::file_of(const Map& map, const std::vector<Source>& sources) {
    Picture picture;
    std::vector<std::size_t> textures;  // of one file
    for (const Source& source : sources) {
        if (source.number == nullptr) {
            // The picture would multiply it.
            if (source.mean != 0) return std::nullopt;
            picture.lowest.push_back(0);
            picture.highest.push_back(0);
            continue;
        }
        const ExportedTexturedNumber& n = *source.number;
        const float white = n.offset + n.scale;
        const bool has_range = map.minimum != nullptr;
        const bool is_factor = !source.channel->is_inverted && (n.offset == 0 || has_range) && n.scale >= 0 &&
                               white <= map.most && n.offset >= n.minimum && white <= n.maximum;
        const std::size_t first = textures.empty() ? n.texture : textures.front();
        if (!is_factor || channel_in_file(scene_, n) != source.channel->of_map ||
            std::string_view(scene_.textures[n.texture].file) != scene_.textures[first].file)
            return std::nullopt;
        textures.push_back(n.texture);
        picture.lowest.push_back(n.offset);
        picture.highest.push_back(white);
    }
    if (map.has_direction && !is_along_tangent(scene_.textures[textures.front()].levels.front()))
        return std::nullopt;
    for (const std::size_t texture : textures) {
        const auto image = pictures_.file_of(texture, map.is_encoded);
        if (!image) return std::nullopt;
        picture.image = *image;
    }
    return picture;
}

TextureMaps::Picture TextureMaps::baked(const Map& map, const std::vector<Source>& sources) {
    std::string key = map.name;
    int width = 1, height = 1, count = 0;
    for (const Source& source : sources) {
        if (source.number == nullptr) {
            key += " -";
            continue;
        }
        const ExportedTexturedNumber& n = *source.number;
        key += fmt::format(" {} {} {} {} {} {}", n.texture, n.texel_channel, n.scale, n.offset, n.minimum,
                           n.maximum);
        const ExportedTextureLevel& level = scene_.textures[n.texture].levels.front();
        if (count++ > 0 && (level.width != width || level.height != height))
            files_.approximate("pictures that share a texture map are brought to one size");
        width = std::max(width, level.width);
        height = std::max(height, level.height);
    }
    const auto [known, is_new] = baked_.try_emplace(key);
    Picture& picture = known->second;
    if (!is_new) return picture;
    const std::size_t channels = sources.back().channel->of_map == 3 ? 4 : 3;
    const std::size_t texels = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
    std::vector<std::uint8_t> bytes(channels * texels, 255);
    if (map.has_direction)
        for (std::size_t i = 0; i < texels; ++i) bytes[channels * i + 1] = 128;
    for (const Source& source : sources) {
        picture.lowest.push_back(0);
        picture.highest.push_back(0);
        if (source.number == nullptr) continue;
        const ExportedTexturedNumber& n = *source.number;
        std::vector<float> values;
        values.reserve(texels);
        for (int y = 0; y < height; ++y)
            for (int x = 0; x < width; ++x)
                values.push_back(
                    source.value(texel_at(scene_.textures[n.texture].levels.front(), n.texel_channel,
                                          (x + 0.5) / width, (y + 0.5) / height)));
        const auto [least, most] = std::ranges::minmax(values);
        float& low = picture.lowest.back();
        float& high = picture.highest.back();
        // A factor that the picture had anyway leaves its bytes as they were.
        const bool is_factor = !source.channel->is_inverted && n.offset == 0 && n.scale > 0 &&
                               n.scale <= map.most && n.scale <= n.maximum && n.minimum <= 0;
        high = !map.has_factor ? 1 : is_factor ? n.scale : most;
        if (map.minimum != nullptr && !is_factor) low = least;
        const float range = high > low ? high - low : 1;
        for (std::size_t i = 0; i < texels; ++i) {
            const float share = std::clamp((values[i] - low) / range, 0.0f, 1.0f);
            const bool is_encoded = map.is_encoded && source.channel->of_map < 3;
            const float stored = is_encoded ? linear_to_srgb(share) : share;
            bytes[channels * i + source.channel->of_map] =
                static_cast<std::uint8_t>(std::lround(255 * stored));
        }
    }
    picture.image = pictures_.add(png_of(width, height, static_cast<int>(channels), bytes), "image/png");
    return picture;
}

}  // namespace candela::gltf_target
