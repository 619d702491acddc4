// The pictures of a scene as targets receive them, and the numbers that objects take from them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>  // before <memory>, whose std::align depends on it
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "scene_export/export_storage.h"

import candela.api;
import candela.scene;
import candela.shading;

namespace candela {

/// Reads each picture once, and puts it into the storage. Throws Error if one cannot be read.
class ExportedTextures {
  public:
    ExportedTextures(ExportStorage& to, ColorEncoding color_management, const TargetAbilities& abilities)
        : to_(to), color_management_(color_management), abilities_(abilities) {}

    /// Adds the numbers of an object that come from pictures or its vertices, and its normal map.
    void add(const Object& object, ExportStorage::Object& to);

  private:
    /// The index of a picture that is decoded like that; objects share them.
    std::size_t texture_of(const std::string& file, ColorEncoding encoding);
    /// The index of the opacity of a picture.
    std::size_t opacity_map_of(const std::string& file);
    /// The index of a picture of normals or slopes.
    std::size_t texture_of(const NormalMap& map);
    void add_texture(const std::string& file, std::shared_ptr<const MipMap> picture);

    std::optional<ExportedNormalMap> normal_map_of(const Object& object);
    void add_numbers(const Object& object, ExportStorage::Object& to);

    ExportStorage& to_;
    ColorEncoding color_management_;
    const TargetAbilities& abilities_;
    std::map<std::pair<std::string, ColorEncoding>, std::size_t> textures_;  // indices of to_.textures
    std::map<std::string, std::size_t> opacity_maps_;
    std::map<std::pair<std::string, std::array<TextureWrap, 2>>, std::size_t> slopes_;  // of bump maps
};

}  // namespace candela
