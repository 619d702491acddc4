// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include <vector>

#include "gltf_document.h"
#include "gltf_json.h"

namespace mesh::gltf {

/// Gives the primitives accessors of what was compressed. Throws BadFile if it is damaged, or declares more
/// than so many bytes can hold.
void decompress(Document& document, const std::vector<DracoPrimitive>& primitives);

}  // namespace mesh::gltf
