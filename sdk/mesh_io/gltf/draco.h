// Primitives compressed by KHR_draco_mesh_compression.
#pragma once

#include <vector>

#include "mesh_io/gltf/document.h"
#include "mesh_io/gltf/json.h"

namespace mesh_io::gltf {

/// Gives the primitives accessors of the decompressed data. Throws BadFile if the stream is damaged, or
/// declares more than its bytes can hold.
void decompress(Document& document, const std::vector<DracoPrimitive>& primitives);

}  // namespace mesh_io::gltf
