module;

#include <map>
#include <memory>
#include <string>

module candela.render:scene_textures;

import candela.api;
import candela.plugins;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

/// The pictures of a scene's textures, each read once.
class SceneTextures {
  public:
    SceneTextures(Registry& registry, Diagnostics& diagnostics, ColorEncoding of_scene)
        : registry_(registry), diagnostics_(diagnostics), of_scene_(of_scene) {}

    /// Keeps the pictures of an object that has been built, for a scene with the same encoding of colours.
    void keep(const SurfaceModels& surface);

    /// Reads what the surface lacks. Problems are reported at the place of the texture.
    void make(const Object& object, SurfaceModels& surface);

  private:
    std::string key_of(const std::string& file, ColorEncoding decoding) const;
    const std::shared_ptr<const MipMap>& picture(const std::string& file, ColorEncoding decoding,
                                                 const SourceLocation& place);
    const std::shared_ptr<const MipMap>& opacity_map(const std::string& file);
    PlacedTexture placed(const ParameterTexture& texture, const Parameter& parameter);
    void make_normal_map(const Object& object, const NormalMap& map, SurfaceModels& surface);

    Registry& registry_;
    Diagnostics& diagnostics_;
    ColorEncoding of_scene_;
    std::map<std::string, std::shared_ptr<const MipMap>> pictures_;  // by PlacedTexture::key
};

/// Reports an object with a texture whose triangles have no texture coordinates.
void require_texture_coordinates(const Object& object, Diagnostics& diagnostics);

}  // namespace candela
