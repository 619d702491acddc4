// The contents of a glTF file that a mesh leaves out.
#pragma once

#include <vector>

#include "mesh_io/gltf/values.h"
#include "mesh_io/surface.h"

namespace mesh_io::gltf {

/// Throws BadFile if the file needs an unsupported extension.
void require_known_extensions(const Json& json);

std::vector<Unsupported> losses_of(const Json& json, Attributes attributes);

}  // namespace mesh_io::gltf
