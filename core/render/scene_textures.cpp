module;

#include <fmt/format.h>

#include <array>
#include <atomic>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <string>
#include <utility>
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

namespace {

/// Whether none has been made for it, or moved from the frame before.
bool lacks_textures(const SurfaceModels& surface) {
    return surface.material_textures.arrays() == 0 && surface.opacity_textures.arrays() == 0;
}

bool tilts_normals(const Object& object, const SurfaceModels& surface) {
    return object.normal_map && surface.shading != nullptr &&
           surface.shading->shading_rate() == ShadingRate::fragment;
}

}  // namespace

void SceneTextures::keep(const SurfaceModels& surface) {
    for (const PlacedTexture& texture : surface.material_textures.textures)
        pictures_[texture.key].mip_map = texture.picture;
    for (const PlacedTexture& texture : surface.opacity_textures.textures)
        pictures_[texture.key].mip_map = texture.picture;
}

SceneTextures::Request SceneTextures::request_of(const std::string& file, ColorEncoding decoding) {
    return {.key = fmt::format("{} {}", static_cast<int>(decoding), file), .file = file, .read = [=, this] {
                return read_texture(file, registry_, decoding);
            }};
}

SceneTextures::Request SceneTextures::request_of(const ParameterTexture& texture,
                                                 const Parameter& parameter) {
    if (texture.channel != TextureChannel::alpha)
        return request_of(texture.file, encoding_of(texture, parameter, of_scene_));
    return {.key = "opacity " + texture.file, .file = texture.file, .read = [file = texture.file, this] {
                return read_opacity_map(file, registry_);
            }};
}

SceneTextures::Request SceneTextures::request_of(const NormalMap& map) {
    if (!map.has_heights) return request_of(map.file, ColorEncoding::none);
    const std::array<TextureWrap, 2> wraps = map.placing.wraps();
    return {.key = fmt::format("slopes {} {} {}", static_cast<int>(wraps[0]), static_cast<int>(wraps[1]),
                               map.file),
            .file = map.file,
            .read = [file = map.file, wraps, this] { return read_bump_map(file, registry_, wraps); }};
}

void SceneTextures::expect(Request request) {
    if (pictures_.try_emplace(request.key).second) expected_.push_back(std::move(request));
}

void SceneTextures::expect(const Object& object, const SurfaceModels& surface) {
    if (!lacks_textures(surface)) return;
    if (tilts_normals(object, surface)) expect(request_of(*object.normal_map));
    const auto note = [&](const ParameterTexture& texture, const Parameter& parameter) {
        expect(request_of(texture, parameter));
        return std::optional<PlacedTexture>();
    };
    MaterialTextures material, opacity;
    MaterialTextures::add_all(object, note, material, opacity);
}

SceneTextures::Picture SceneTextures::read(const Request& request) {
    try {
        TextureImage image = request.read();
        return {.mip_map = std::move(image.mip_map), .was_clamped = image.was_clamped};
    } catch (const MemoryShortage&) {
        throw;
    } catch (const Error&) {
        return {.problem = std::current_exception()};
    }
}

void SceneTextures::read_together(const std::vector<Request>& wanted,
                                  std::vector<std::optional<Picture>>& pictures) {
    std::atomic<bool> is_short = false;
    const auto read_some = [&](std::size_t begin, std::size_t end) {
        try {
            for (std::size_t i = begin; i < end && !is_short; ++i) pictures[i] = read(wanted[i]);
        } catch (const MemoryShortage&) {
            is_short = true;
        }
    };
    // One thread each: while waiting for others, it would begin with further pictures.
    parallel_for(wanted.size(), 1, [&](std::size_t begin, std::size_t end) {
        with_threads(1, [&] { read_some(begin, end); });
    });
}

void SceneTextures::read(int threads) {
    const std::vector<Request> wanted = std::exchange(expected_, {});
    if (wanted.empty()) return;
    std::vector<std::optional<Picture>> pictures(wanted.size());
    if (wanted.size() > 1) with_threads(threads, [&] { read_together(wanted, pictures); });
    // Alone, a picture may have enough memory. If not, one message about it is enough.
    for (std::size_t i = 0; i < wanted.size(); ++i) {
        try {
            if (!pictures[i]) with_threads(threads, [&] { pictures[i] = read(wanted[i]); });
            pictures_[wanted[i].key] = *std::move(pictures[i]);
        } catch (const MemoryShortage&) {
            pictures_[wanted[i].key].problem = std::current_exception();
            return;
        }
    }
}

std::shared_ptr<const MipMap> SceneTextures::picture(const Request& request, const SourceLocation& place) {
    Picture& known = pictures_[request.key];
    if (known.problem) std::rethrow_exception(std::exchange(known.problem, nullptr));
    if (std::exchange(known.was_clamped, false))
        diagnostics_.warning(place, fmt::format("the texture '{}' has intensities above 1, which are "
                                                "clamped: a surface cannot reflect more",
                                                request.file));
    return known.mip_map;
}

void SceneTextures::make(const Object& object, SurfaceModels& surface) {
    if (!lacks_textures(surface)) return;
    if (object.normal_map) make_normal_map(object, *object.normal_map, surface);
    const auto place = [&](const ParameterTexture& texture, const Parameter& parameter) {
        std::optional<PlacedTexture> result;
        reported(diagnostics_, fmt::format("'{}' of object {}", texture.parameter, object.label.text()),
                 texture.place, [&] {
                     const Request request = request_of(texture, parameter);
                     auto picture = this->picture(request, texture.place);
                     if (picture != nullptr)
                         result = PlacedTexture{request.key, std::move(picture), texture.placing};
                 });
        return result;
    };
    MaterialTextures::add_all(object, place, surface.material_textures, surface.opacity_textures);
    surface.has_channels = !vertex_channels_of(object).empty();
}

void SceneTextures::make_normal_map(const Object& object, const NormalMap& map, SurfaceModels& surface) {
    const char* const key = map.has_heights ? "bump_map" : "normal_map";
    if (surface.shading == nullptr) return;  // an error has been reported
    if (!tilts_normals(object, surface)) {
        diagnostics_.warning(
            map.place, fmt::format("'{}' of object {} has no effect: shading/{} evaluates light once per {}",
                                   key, object.label.text(), surface.shading_plugin,
                                   surface.shading->shading_rate() == ShadingRate::face ? "face" : "vertex"));
        return;
    }
    reported(diagnostics_, fmt::format("'{}' of object {}", key, object.label.text()), map.place, [&] {
        const Request request = request_of(map);
        const std::shared_ptr<const MipMap> texels = picture(request, map.place);
        if (texels == nullptr) return;
        surface.material_textures.add(map, {request.key, texels, map.placing}, texels->width(),
                                      texels->height());
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
