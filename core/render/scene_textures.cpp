module;

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <string>

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
        return {"opacity " + texture.file, opacity_map(texture.file), texture.wrap, texture.transform};
    const ColorEncoding decoding = encoding_of(texture, parameter, of_scene_);
    return {key_of(texture.file, decoding), picture(texture.file, decoding, texture.place), texture.wrap,
            texture.transform};
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
            name = fmt::format("{} {}", map.wrap == TextureWrap::repeat ? "slopes" : "slopes, clamped", name);
            auto& slopes = pictures_[name];
            if (slopes == nullptr) slopes = read_bump_map(map.file, registry_, map.wrap).mip_map;
            texels = slopes;
        } else {
            texels = picture(map.file, ColorEncoding::none, map.place);
        }
        if (texels == nullptr) return;
        surface.material_textures.add(map, {name, texels, map.wrap, map.transform}, texels->width(),
                                      texels->height());
    });
}

void require_texture_coordinates(const Object& object, Diagnostics& diagnostics) {
    const auto& textures = object.textures.empty() ? object.common.textures : object.textures;
    const ParameterTexture* const first = object.color_texture ? &*object.color_texture
                                          : textures.empty()   ? nullptr
                                                               : &textures.front();
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
