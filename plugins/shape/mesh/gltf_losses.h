// The contents of a glTF file that a mesh leaves out.
#pragma once

#include <vector>

#include "gltf_values.h"
#include "surface.h"

namespace mesh::gltf {

/// Throws BadFile if the file needs an unsupported extension.
void require_known_extensions(const Json& json);

std::vector<Unsupported> losses_of(const Json& json);

}  // namespace mesh::gltf
