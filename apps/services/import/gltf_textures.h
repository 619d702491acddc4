// The textures of a glTF file's materials: its pictures, and how materials use them.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/gltf_container.h"
#include "import/images.h"
#include "import/model.h"

import candela.plugins;

namespace importing::gltf {

/// The channels of a picture that a parameter takes.
enum class Channel { red, green, blue, alpha, rgb };

class Textures {
  public:
    struct MeasuredImage {
        Image file;
        Means means;
        std::optional<std::size_t> index{};  // index in the model, once a surface shows it
    };
    /// A picture as a material places it.
    struct Placed {
        MeasuredImage* image = nullptr;
        Placing placing{};
    };

    /// Reads the pictures of all materials. Notes losses in `model` and adds pictures to it.
    Textures(Container& container, candela::Registry& registry, Model& model);

    /// The texture of that name in a part of a material; nothing if there is none, or if it cannot be used,
    /// which is noted. `material`: as notes name it.
    std::optional<Placed> texture(const Json& from, const char* name, const std::string& material);
    /// Uses a material's colour texture, times `factor`, for the surface, if it has one.
    void show(const Json& from, const char* name, const std::string& material, std::vector<double> factor,
              Material& to);
    /// Makes offset + scale * texel the values of a parameter, and returns their mean.
    std::vector<double> map(const Placed& picture, Channel channel, const char* parameter,
                            std::vector<double> scale, std::vector<double> offset, Material& to);
    /// Uses a material's normal map, if it has one.
    void tilt_normals(const Json& material, const std::string& name, Material& to);

  private:
    /// A picture that has been read, and what its first material notes.
    struct ReadPicture {
        std::optional<MeasuredImage> image{};  // none: it cannot be read
        std::string problem{}, other_format{};
        bool is_noted = false;
    };

    /// The image of a texture; null if it cannot be read.
    MeasuredImage* image_of(const Json& info, const std::string& material);
    MeasuredImage* image_at(std::size_t index, const std::string& material);
    /// The number of the image that a texture shows.
    static std::optional<std::size_t> source_of(const Json& texture);
    /// Throws candela::MemoryShortage.
    ReadPicture read(Image file) const;
    ReadPicture read(std::size_t image);
    /// Reads the images of all materials, several at a time.
    void read_all();
    /// How a texture continues beyond its edges.
    void wrap(const Json& info, Placing& to) const;
    /// Whether a mesh of the file has them.
    bool has_second_uv() const;
    std::size_t index_of_image(MeasuredImage& image);

    Container& container_;
    const Json& json_;
    candela::Registry& registry_;
    Model& model_;
    std::map<std::size_t, ReadPicture> images_;
};

}  // namespace importing::gltf
