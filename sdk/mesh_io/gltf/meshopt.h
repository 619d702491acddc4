// Buffer views compressed by EXT_meshopt_compression.
#pragma once

#include <vector>

#include "mesh_io/gltf/document.h"
#include "mesh_io/gltf/json.h"

namespace mesh_io::gltf {

/// Replaces `views` by their decompressed bytes. Throws BadFile if they are damaged, or declare more than
/// their bytes can hold.
void decompress(Document& document, const std::vector<CompressedView>& views);

}  // namespace mesh_io::gltf
