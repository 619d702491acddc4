// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include <vector>

#include "gltf_document.h"
#include "gltf_json.h"

namespace mesh::gltf {

/// Gives the primitives accessors of the decompressed data. Throws BadFile if the stream is damaged, or
/// declares more than its bytes can hold.
void decompress(Document& document, const std::vector<DracoPrimitive>& primitives);

}  // namespace mesh::gltf
