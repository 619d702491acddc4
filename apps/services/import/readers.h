// Reads the contents of model files other than their triangles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "import/model.h"

import candela.plugins;

namespace importing {

/// A model's file, and the files it may refer to.
struct Source {
    std::filesystem::path file;
    bool allows_outside = false;  // the model may name files outside its folder

    bool may_read(const std::filesystem::path& part) const;
};

/// The advice for messages about a file that a model may not read.
inline constexpr const char* k_outside_remedy = "; --allow-outside reads it";

/// Wavefront OBJ with its material libraries. Never throws for errors in a library or a picture; notes them
/// instead.
Model read_obj(const Source& source, candela::Registry& registry);

/// glTF 2.0 or GLB whose triangles have been read, with its first animation if wanted. Throws candela::Error
/// (failure) for an invalid file.
Model read_gltf(const Source& source, bool with_animation, candela::Registry& registry);

/// PLY with the texture named in MeshLab's comment.
Model read_ply(const Source& source, candela::Registry& registry);

/// The names of the textures of a PLY file; none of an invalid file.
std::vector<std::string> textures_of_ply(const std::filesystem::path& file);

/// Whether `part`, which `model` refers to, is in its folder or below once links are resolved: models are
/// often someone else's.
bool is_beside(const std::filesystem::path& part, const std::filesystem::path& model);

/// Whether an image plugin reads the picture, or, if it does not exist, pictures of that name.
bool is_readable_image(const std::filesystem::path& file, candela::Registry& registry);

}  // namespace importing
