module;

#include <fmt/format.h>

#include <memory>
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

void SceneTextures::keep(const Object& object, const SurfaceModels& surface) {
    if (surface.color_texture != nullptr)
        pictures_[key_of(object.color_texture, of_scene_)] = surface.color_texture;
    for (const PlacedTexture& texture : surface.material_textures.textures)
        pictures_[texture.key] = texture.picture;
}

/// Null if it cannot be read, which was an Error before.
const std::shared_ptr<const MipMap>& SceneTextures::picture(const std::string& file, ColorEncoding decoding,
                                                            const SourceLocation& place) {
    const auto [known, is_new] = pictures_.try_emplace(key_of(file, decoding));
    if (!is_new) return known->second;
    TextureImage read = read_texture(file, registry_, decoding);
    if (read.was_clamped)
        diagnostics_.warning(place, fmt::format("the texture '{}' has intensities above 1, which are "
                                                "clamped: a surface cannot reflect more",
                                                file));
    known->second = read.mip_map;
    return known->second;
}

void SceneTextures::make(const Object& object, SurfaceModels& surface) {
    if (!object.color_texture.empty() && surface.color_texture == nullptr)
        reported(diagnostics_, "object " + object.label.text(), object.texture_place, [&] {
            surface.color_texture = picture(object.color_texture, of_scene_, object.texture_place);
        });
    if (!surface.material_textures.numbers.empty()) return;
    for (const ParameterTexture& texture : object.textures) {
        reported(diagnostics_, fmt::format("'{}' of object {}", texture.parameter, object.label.text()),
                 texture.place, [&] {
                     const ParamSet& values = object.reflection.parameters;
                     const std::size_t index = values.index_of(texture.parameter);
                     const Parameter& parameter = values.schema()[index];
                     const ColorEncoding decoding = encoding_of(texture, parameter, of_scene_);
                     surface.material_textures.add(
                         texture, parameter, index,
                         {key_of(texture.file, decoding), picture(texture.file, decoding, texture.place),
                          texture.wrap, texture.transform});
                 });
    }
}

void require_texture_coordinates(const Object& object, Diagnostics& diagnostics) {
    const bool is_of_color = !object.color_texture.empty();
    diagnostics.error(
        is_of_color ? object.texture_place : object.textures.front().place,
        fmt::format("object {} has no texture coordinates, which a texture needs", object.label.text()),
        fmt::format("remove {}, or give the shape texture coordinates",
                    is_of_color ? "color_texture"
                                : fmt::format("the texture of '{}'", object.textures.front().parameter)));
}

}  // namespace candela
