#include "scene_export/exported_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

import candela.api;
import candela.plugins;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

bool is_of_vertices(const TexturedNumber& number) { return number.vertex_channel != TexturedNumber::k_none; }

std::array<ExportedWrap, 2> exported_wraps(const TexturePlacing& placing) {
    const auto [u, v] = placing.wraps();
    return {static_cast<ExportedWrap>(u), static_cast<ExportedWrap>(v)};
}

ExportedTexturedNumber exported_number(const TexturedNumber& number, const PlacedTexture& placed,
                                       std::size_t picture) {
    ExportedTexturedNumber result{.parameter = number.parameter,
                                  .channel = number.channel,
                                  .texture = picture,
                                  .texel_channel = number.texel_channel,
                                  .vertex_channel = number.vertex_channel,
                                  .uv = placed.placing.uv,
                                  .scale = number.scale,
                                  .offset = number.offset,
                                  .minimum = number.minimum,
                                  .maximum = number.maximum};
    std::ranges::copy(exported_wraps(placed.placing), result.wrap);
    std::ranges::copy(placing_of(placed.placing.transform), result.placing);
    return result;
}

}  // namespace

void ExportedTextures::add(const Object& object, ExportStorage::Object& to) {
    add_numbers(object, to);
    to.normal_map = normal_map_of(object);
}

std::size_t ExportedTextures::texture_of(const std::string& file, ColorEncoding encoding) {
    const auto [known, is_new] = textures_.try_emplace({file, encoding}, to_.textures.size());
    if (is_new) add_texture(file, read_texture(file, to_.registry, encoding).mip_map);
    return known->second;
}

std::size_t ExportedTextures::opacity_map_of(const std::string& file) {
    const auto [known, is_new] = opacity_maps_.try_emplace(file, to_.textures.size());
    if (is_new) {
        add_texture(file, read_opacity_map(file, to_.registry).mip_map);
        to_.textures.back().is_opacity = true;
    }
    return known->second;
}

std::size_t ExportedTextures::texture_of(const NormalMap& map) {
    if (!map.has_heights) return texture_of(map.file, ColorEncoding::none);
    const std::array<TextureWrap, 2> wraps = map.placing.wraps();
    const auto [known, is_new] = slopes_.try_emplace({map.file, wraps}, to_.textures.size());
    if (is_new) add_texture(map.file, read_bump_map(map.file, to_.registry, wraps).mip_map);
    return known->second;
}

void ExportedTextures::add_texture(const std::string& file, std::shared_ptr<const MipMap> picture) {
    const auto& mip_map = to_.mip_maps.emplace_back(std::move(picture));
    auto& levels = to_.levels.emplace_back();
    for (const MipMap::Level& level : mip_map->levels()) {
        const auto texels = static_cast<std::size_t>(level.width) * static_cast<std::size_t>(level.height);
        levels.push_back({level.width, level.height, mip_map->texels().subspan(3 * level.first, 3 * texels)});
    }
    to_.textures.push_back({.file = to_.labels.emplace_back(file).c_str(), .levels = levels});
}

std::optional<ExportedNormalMap> ExportedTextures::normal_map_of(const Object& object) {
    if (!object.normal_map) return std::nullopt;
    const NormalMap& map = *object.normal_map;
    if (!abilities_.normal_maps)
        throw Error(ErrorCategory::failure,
                    fmt::format("object {} has a {}, which this target does not support; remove it",
                                object.label.text(), map.has_heights ? "bump_map" : "normal_map"));
    if (map.placing.uv != 0 && !abilities_.second_uv) return std::nullopt;
    ExportedNormalMap exported{
        .texture = texture_of(map), .uv = map.placing.uv, .has_slopes = map.has_heights, .scale = map.scale};
    const MipMap& picture = *to_.mip_maps[exported.texture];
    MaterialTextures textures;
    textures.add(map, {}, picture.width(), picture.height());
    std::ranges::copy(exported_wraps(map.placing), exported.wrap);
    std::ranges::copy(placing_of(map.placing.transform), exported.placing);
    std::ranges::copy(textures.normal->to_uv, exported.to_uv);
    return exported;
}

void ExportedTextures::add_numbers(const Object& object, ExportStorage::Object& to) {
    if (object.textures.empty() && object.common.textures.empty() && !object.color_texture) return;
    std::map<std::string, std::size_t> pictures;  // by the key of a placed one: index of to_.textures
    const auto place = [&](const ParameterTexture& texture,
                           const Parameter& parameter) -> std::optional<PlacedTexture> {
        const bool is_opacity = &parameter == &material_parameter("opacity");
        if (is_opacity && !abilities_.opacity) return std::nullopt;
        if (texture.placing.uv != 0 && !abilities_.second_uv) return std::nullopt;
        const std::size_t picture =
            texture.channel == TextureChannel::alpha
                ? opacity_map_of(texture.file)
                : texture_of(texture.file, encoding_of(texture, parameter, color_management_));
        std::string key = fmt::format("{}", picture);
        pictures.emplace(key, picture);
        return PlacedTexture{std::move(key), nullptr, texture.placing};
    };
    MaterialTextures textures, of_opacity;
    MaterialTextures::add_all(object, place, textures, of_opacity);
    const auto exported = [&](const MaterialTextures& of, const TexturedNumber& number) {
        if (is_of_vertices(number)) return exported_number(number, {}, 0);
        const PlacedTexture& placed = of.textures[number.texture];
        return exported_number(number, placed, pictures.at(placed.key));
    };
    const auto is_left_out = [&](const TexturedNumber& number) {
        return is_of_vertices(number) && !abilities_.vertex_channels;
    };
    for (const TexturedNumber& number : of_opacity.numbers)
        if (abilities_.opacity && !is_left_out(number))
            to.opacity_numbers.push_back(exported(of_opacity, number));
    for (std::size_t i = 0; i < textures.numbers.size(); ++i) {
        const TexturedNumber& number = textures.numbers[i];
        if (is_left_out(number)) continue;
        const bool is_of_model = i < textures.of_model, is_occlusion = i == textures.occlusion,
                   is_color = i >= textures.color && i - textures.color < 3;
        (is_of_model    ? to.textured_numbers
         : is_occlusion ? to.occlusion_numbers
         : is_color     ? to.color_numbers
                        : to.emission_numbers)
            .push_back(exported(textures, number));
    }
}

}  // namespace candela
