// Materials in the form of glTF: its own model, and the nearest to others.
#pragma once

#include <cstddef>
#include <optional>

#include "candela/math.h"
#include "candela/target.h"
#include "document.h"
#include "pictures.h"
#include "texture_maps.h"

namespace candela::gltf_target {

/// Adds the materials of objects, and their textures.
class Materials {
  public:
    Materials(const ExportedScene& scene, Document& document, FileSink& files)
        : scene_(scene), document_(document), files_(files) {}

    /// The index of an object's material; `vertex_alpha`: the factor of its alpha, if its vertices have one.
    /// Throws std::runtime_error if its texture is neither a PNG nor a JPEG file.
    std::size_t add(const ExportedObject& object, const std::optional<float>& vertex_alpha, bool is_closed);

  private:
    /// The nearest to a model that glTF does not have.
    Json approximate(const ExportedReflection& model, const ExportedValues& values, Vec3 color);

    const ExportedScene& scene_;
    Document& document_;
    FileSink& files_;
    Pictures pictures_{scene_, document_};
    TextureMaps maps_{scene_, document_, pictures_, files_};
};

}  // namespace candela::gltf_target
