// Buffer views compressed by EXT_meshopt_compression.
#pragma once

#include <vector>

#include "gltf_document.h"
#include "gltf_json.h"

namespace mesh::gltf {

/// Replaces `views` by their decompressed bytes. Throws BadFile if they are damaged, or declare more than
/// their bytes can hold.
void decompress(Document& document, const std::vector<CompressedView>& views);

}  // namespace mesh::gltf
