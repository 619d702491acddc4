// A glTF file's materials in the words of a scene.
#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "import/gltf_container.h"
#include "import/gltf_json.h"
#include "import/model.h"
#include "import/pictures.h"

import candela.registry;

namespace importing::gltf {

/// A linear colour as a scene has it.
Vector encoded(const std::vector<double>& linear);

class Materials {
  public:
    /// What is lost is noted in `model`, to which pictures are added.
    Materials(Container& container, candela::Registry& registry, Model& model);

    Material material(std::size_t index);

  private:
    struct Image {
        Picture file;
        Means means;
        OpacityMap opacity;
        std::optional<std::size_t> cutout{};   // of the model
        std::optional<std::size_t> picture{};  // of the model, once a surface shows it
    };

    Material metallic_roughness(const Json& from, const std::string& name);
    Material specular_glossiness(const Json& from, const Json& extension, const std::string& name);
    void note_losses(const Json& from);
    /// Cuts a surface along the outline of its texture's opacity, where the material asks for that.
    void cut_out(const Json& from, double factor, Image* image, Material& to);
    /// The colour texture of a material, which becomes that of the surface; null if there is none.
    Image* show(const Json& info, const std::string& material, Material& to);
    /// The image that a texture shows, if it can be read.
    Image* image_of(const Json& info, const std::string& material);
    Image* image_at(std::size_t index, const std::string& material);

    Container& container_;
    const Json& json_;
    candela::Registry& registry_;
    Model& model_;
    std::map<std::size_t, std::optional<Image>> images_;
};

}  // namespace importing::gltf
