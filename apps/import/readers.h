// What files of each kind say beside their triangles.
#pragma once

#include <filesystem>

#include "import/model.h"

import candela.registry;

namespace importing {

/// Wavefront OBJ with its material libraries. Never throws for what is wrong with a library or a picture:
/// that is noted.
Model read_obj(const std::filesystem::path& file, candela::Registry& registry);

/// glTF 2.0 or GLB whose triangles have been read. Throws candela::Error (failure) for what is no such file.
Model read_gltf(const std::filesystem::path& file, candela::Registry& registry);

/// Whether `part`, which `model` names as a part of itself, lies in its folder or below, once links are
/// resolved: models are often somebody else's.
bool is_beside(const std::filesystem::path& part, const std::filesystem::path& model);

/// Whether an image plugin reads pictures of that name.
bool is_readable_picture(const std::filesystem::path& file, candela::Registry& registry);

}  // namespace importing
