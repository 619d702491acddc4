module;

#include <fmt/format.h>

#include <array>
#include <memory>
#include <optional>
#include <string>
#include <vector>

module candela.render;

import :reported;
import :scene_textures;
import candela.api;
import candela.plugins;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

std::string SceneTextures::key_of(const std::string& file, ColorEncoding decoding) const {
    return fmt::format("{} {}", static_cast<int>(decoding), file);
}

void SceneTextures::keep(const SurfaceModels& surface) {
    for (const PlacedTexture& texture : surface.material_textures.textures)
        pictures_[texture.key] = texture.picture;
    for (const PlacedTexture& texture : surface.opacity_textures.textures)
        pictures_[texture.key] = texture.picture;
}

/// Null if it cannot be read, which was an Error before.
const std::shared_ptr<const MipMap>& SceneTextures::picture(const std::string& file, ColorEncoding decoding,
                                                            const SourceLocation& place) {
    const auto [known, is_new] = pictures_.try_emplace(key_of(file, decoding));
    if (!is_new) return known->second;
    const TextureImage read = read_texture(file, registry_, decoding);
    if (read.was_clamped)
        diagnostics_.warning(place, fmt::format("the texture '{}' has intensities above 1, which are "
                                                "clamped: a surface cannot reflect more",
                                                file));
    known->second = read.mip_map;
    return known->second;
}

const std::shared_ptr<const MipMap>& SceneTextures::opacity_map(const std::string& file) {
    auto& known = pictures_["opacity " + file];
    if (known == nullptr) known = read_opacity_map(file, registry_).mip_map;
    return known;
}

PlacedTexture SceneTextures::placed(const ParameterTexture& texture, const Parameter& parameter) {
    if (texture.channel == TextureChannel::alpha)
        return {"opacity " + texture.file, opacity_map(texture.file), texture.placing};
    const ColorEncoding decoding = encoding_of(texture, parameter, of_scene_);
    return {key_of(texture.file, decoding), picture(texture.file, decoding, texture.place), texture.placing};
}

void SceneTextures::make(const Object& object, SurfaceModels& surface) {
    if (surface.material_textures.arrays() > 0 || surface.opacity_textures.arrays() > 0) return;
    if (object.normal_map) make_normal_map(object, *object.normal_map, surface);
    const auto place = [&](const ParameterTexture& texture, const Parameter& parameter) {
        std::optional<PlacedTexture> result;
        reported(diagnostics_, fmt::format("'{}' of object {}", texture.parameter, object.label.text()),
                 texture.place, [&] { result = placed(texture, parameter); });
        return result;
    };
    MaterialTextures::add_all(object, place, surface.material_textures, surface.opacity_textures);
    surface.has_channels = !vertex_channels_of(object).empty();
}

void SceneTextures::make_normal_map(const Object& object, const NormalMap& map, SurfaceModels& surface) {
    const char* const key = map.has_heights ? "bump_map" : "normal_map";
    if (surface.shading == nullptr) return;  // an error has been reported
    const ShadingRate rate = surface.shading->shading_rate();
    if (rate != ShadingRate::fragment) {
        diagnostics_.warning(
            map.place, fmt::format("'{}' of object {} has no effect: shading/{} evaluates light once per {}",
                                   key, object.label.text(), surface.shading_plugin,
                                   rate == ShadingRate::face ? "face" : "vertex"));
        return;
    }
    reported(diagnostics_, fmt::format("'{}' of object {}", key, object.label.text()), map.place, [&] {
        std::string name = key_of(map.file, ColorEncoding::none);
        std::shared_ptr<const MipMap> texels;
        if (map.has_heights) {
            const std::array<TextureWrap, 2> wraps = map.placing.wraps();
            name =
                fmt::format("slopes {} {} {}", static_cast<int>(wraps[0]), static_cast<int>(wraps[1]), name);
            auto& slopes = pictures_[name];
            if (slopes == nullptr) slopes = read_bump_map(map.file, registry_, wraps).mip_map;
            texels = slopes;
        } else {
            texels = picture(map.file, ColorEncoding::none, map.place);
        }
        if (texels == nullptr) return;
        surface.material_textures.add(map, {name, texels, map.placing}, texels->width(), texels->height());
    });
}

void require_texture_coordinates(const Object& object, Diagnostics& diagnostics) {
    std::vector<const ParameterTexture*> pictures;
    if (object.color_texture) pictures.push_back(&*object.color_texture);
    for (const auto* const textures : {&object.textures, &object.common.textures})
        for (const ParameterTexture& texture : *textures) pictures.push_back(&texture);
    // The shape has reported missing second ones.
    std::erase_if(pictures, [](const ParameterTexture* texture) {
        return texture->file.empty() || texture->placing.uv != 0;
    });
    const ParameterTexture* const first = pictures.empty() ? nullptr : pictures.front();
    if (first == nullptr && (!object.normal_map || object.normal_map->placing.uv != 0)) return;
    const SourceLocation& place = first != nullptr ? first->place : object.normal_map->place;
    const std::string what = first != nullptr ? fmt::format("the texture of '{}'", first->parameter)
                             : object.normal_map->has_heights ? "bump_map"
                                                              : "normal_map";
    diagnostics.error(
        place,
        fmt::format("object {} has no texture coordinates, which a texture needs", object.label.text()),
        fmt::format("remove {}, or give the shape texture coordinates", what));
}

}  // namespace candela
