// What files of each kind say beside their triangles.
#pragma once

#include <filesystem>

#include "import/model.h"

import candela.registry;

namespace importing {

/// A model's file, and which files it may name as parts of itself.
struct Source {
    std::filesystem::path file;
    bool allows_outside = false;  // of its folder

    bool may_read(const std::filesystem::path& part) const;
};

/// What to add to a message about a file that a model may not read.
inline constexpr const char* k_outside_remedy = "; --allow-outside reads it";

/// Wavefront OBJ with its material libraries. Never throws for what is wrong with a library or a picture:
/// that is noted.
Model read_obj(const Source& source, candela::Registry& registry);

/// glTF 2.0 or GLB whose triangles have been read, with its first animation where that is asked for. Throws
/// candela::Error (failure) for what is no such file.
Model read_gltf(const Source& source, bool with_animation, candela::Registry& registry);

/// PLY with the texture that a comment of MeshLab's names.
Model read_ply(const Source& source, candela::Registry& registry);

/// Whether `part`, which `model` names as a part of itself, lies in its folder or below, once links are
/// resolved: models are often somebody else's.
bool is_beside(const std::filesystem::path& part, const std::filesystem::path& model);

/// Whether an image plugin reads the picture, or pictures of that name if it is not there.
bool is_readable_picture(const std::filesystem::path& file, candela::Registry& registry);

}  // namespace importing
