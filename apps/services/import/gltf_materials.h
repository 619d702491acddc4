// Translates a glTF file's materials to a scene's.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "import/gltf_container.h"
#include "import/gltf_textures.h"
#include "import/model.h"

import candela.plugins;

namespace importing::gltf {

class Materials {
  public:
    /// Notes losses in `model` and adds pictures to it.
    Materials(Container& container, candela::Registry& registry, Model& model);

    Material material(std::size_t index);

  private:
    Material unlit(const Json& from, const std::string& name);
    Material metallic_roughness(const Json& from, const std::string& name);
    Material specular_glossiness(const Json& from, const Json& extension, const std::string& name);
    /// The model has one normal for all of its layers.
    void note_coat_normals(const Json& from);
    void note_losses(const Json& from);
    /// A parameter: offset + scale times a channel of a texture, or times 1 without one.
    void add(const std::optional<Textures::Placed>& map, Channel channel, const char* parameter,
             const std::vector<double>& scale, const std::vector<double>& offset, Material& to);
    /// The parts of a material that extensions add, each only if the file has it.
    void add_extensions(const Json& extensions, const std::string& name, Material& to);
    /// The parts of a material that do not depend on how it reflects.
    void add_emission(const Json& from, const std::string& name, Material& to);
    /// `colors`: the part of the material that has the texture of its colour, whose alpha counts.
    void add_opacity(const Json& from, const Json& colors, const char* texture, double factor,
                     const std::string& name, Material& to);
    /// Whether triangles of a material have an alpha at their vertices, which multiplies its own.
    bool has_vertex_alpha(const Json& material) const;
    void add_occlusion(const Json& from, const std::string& name, Material& to);
    /// The mean angle in the texture of KHR_materials_anisotropy, in radians.
    double direction_in(const Textures::Placed& map);

    const Json& json_;
    Model& model_;
    Textures textures_;
};

}  // namespace importing::gltf
