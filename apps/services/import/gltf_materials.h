// Translates a glTF file's materials to a scene's.
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

class Materials {
  public:
    /// Notes losses in `model` and adds pictures to it.
    Materials(Container& container, candela::Registry& registry, Model& model);

    Material material(std::size_t index);

  private:
    struct MeasuredImage {
        Image file;
        Means means;
        OpacityMap opacity;
        std::optional<std::size_t> cutout{};  // index in the model
        std::optional<std::size_t> index{};   // index in the model, once a surface shows it
    };

    Material unlit(const Json& from, const std::string& name);
    Material metallic_roughness(const Json& from, const std::string& name);
    Material specular_glossiness(const Json& from, const Json& extension, const std::string& name);
    void note_losses(const Json& from);
    /// Cuts a surface along the outline of its texture's opacity if the material asks for that.
    void cut_out(const Json& from, double factor, MeasuredImage* image, Material& to);
    /// Uses a material's colour texture for the surface, and returns its image; null if there is none.
    MeasuredImage* show(const Json& info, const std::string& material, Material& to);
    /// The image of a texture; null if it cannot be read.
    MeasuredImage* image_of(const Json& info, const std::string& material);
    MeasuredImage* image_at(std::size_t index, const std::string& material);

    Container& container_;
    const Json& json_;
    candela::Registry& registry_;
    Model& model_;
    std::map<std::size_t, std::optional<MeasuredImage>> images_;
};

}  // namespace importing::gltf
