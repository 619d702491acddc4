// Parameters that pictures give, as glTF's texture maps.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "candela/target.h"
#include "document.h"
#include "pictures.h"

namespace candela::gltf_target {

class TextureMaps {
  public:
    TextureMaps(const ExportedScene& scene, Document& document, Pictures& pictures, FileSink& files)
        : scene_(scene), document_(document), pictures_(pictures), files_(files) {}

    /// Adds maps to a material of glTF's own model, which has the means of the pictures in `values`.
    /// Parameters for which glTF has no map keep their mean, which is reported.
    void add(const ExportedObject& object, std::span<const ParamValue> values, Json& material);
    /// Adds an object's opacity, and the picture of its colour and opacity, to a material of any model, whose
    /// colour the picture multiplies; `vertex_alpha`: as of Materials::add().
    void add_color(const ExportedObject& object, const std::optional<float>& vertex_alpha, Json& material);
    /// Adds what an object emits, and its occlusion, to a material of any model.
    void add_emission(const ExportedObject& object, Json& material);
    void add_occlusion(const ExportedObject& object, Json& material);

    /// Adds the object's normal map to a material, if it has one; a bump map is left out, which is reported.
    void add_normals(const ExportedObject& object, Json& material);

    struct Channel;
    struct Map;

  private:
    /// The origin of a channel of a map: a picture or, without one, a constant.
    struct Source {
        const Channel* channel = nullptr;
        const ExportedTexturedNumber* number = nullptr;
        std::size_t parameter = 0;
        float mean = 0;

        float value(float texel) const;
    };
    /// A picture, and the range of each channel's values in it.
    struct Picture {
        std::size_t image = 0;
        std::vector<float> lowest, highest;
    };

    void add(const ExportedObject& object, const Map& map, std::vector<Source> sources, Json& material);
    /// The reference to a picture, as a number or a normal map reads it.
    template <class Reader>
    Json info_of(std::size_t image, const Reader& reader);
    /// Sources that glTF reads from the file of their one picture; nothing if it cannot.
    std::optional<Picture> file_of(const Map& map, const std::vector<Source>& sources);
    Picture baked(const Map& map, const std::vector<Source>& sources);

    const ExportedScene& scene_;
    Document& document_;
    Pictures& pictures_;
    FileSink& files_;
    std::map<std::string, Picture> baked_;  // by all that they depend on
};

}  // namespace candela::gltf_target
