module;

#include <exception>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

module candela.render:scene_textures;

import candela.api;
import candela.plugins;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

/// The pictures of a scene's textures, each read once, several at a time.
class SceneTextures {
  public:
    SceneTextures(Registry& registry, Diagnostics& diagnostics, ColorEncoding of_scene)
        : registry_(registry), diagnostics_(diagnostics), of_scene_(of_scene) {}

    /// Keeps the pictures of an object that has been built, for a scene with the same encoding of colours.
    void keep(const SurfaceModels& surface);

    /// Expects the pictures that the surface lacks.
    void expect(const Object& object, const SurfaceModels& surface);
    /// Reads what is expected, with that many threads; 0: all.
    void read(int threads);
    /// Gives the surface the textures that it lacks; their pictures have been read. Problems are reported at
    /// the place of the first texture that has them.
    void make(const Object& object, SurfaceModels& surface);

  private:
    /// A picture, and how it is read.
    struct Request {
        std::string key{};  // PlacedTexture::key
        std::string file{};
        std::function<TextureImage()> read{};
    };
    struct Picture {
        std::shared_ptr<const MipMap> mip_map{};
        bool was_clamped = false;
        std::exception_ptr problem{};  // why there is none
    };

    Request request_of(const ParameterTexture& texture, const Parameter& parameter);
    Request request_of(const NormalMap& map);
    Request request_of(const std::string& file, ColorEncoding decoding);
    void expect(Request request);
    /// Leaves out those that memory was short for while others were read.
    static void read_together(const std::vector<Request>& wanted,
                              std::vector<std::optional<Picture>>& pictures);
    /// Throws MemoryShortage; other Errors are the picture's.
    static Picture read(const Request& request);
    /// Null if it could not be read, which has been reported for another texture. Throws why it could not.
    std::shared_ptr<const MipMap> picture(const Request& request, const SourceLocation& place);
    void make_normal_map(const Object& object, const NormalMap& map, SurfaceModels& surface);

    Registry& registry_;
    Diagnostics& diagnostics_;
    ColorEncoding of_scene_;
    std::vector<Request> expected_;
    std::map<std::string, Picture> pictures_;  // by PlacedTexture::key
};

/// Reports an object with a texture whose triangles have no texture coordinates.
void require_texture_coordinates(const Object& object, Diagnostics& diagnostics);

}  // namespace candela
