// What a glTF file says about triangles, read by tinygltf from no more than that.
#pragma once

// Images are not decoded, and files are read by us.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE
#define TINYGLTF_NO_INCLUDE_STB_IMAGE_WRITE
#define TINYGLTF_NO_EXTERNAL_IMAGE
#define TINYGLTF_NO_FS
#include <fstream>
// clang-format off: it needs the header above.
#include <tiny_gltf.h>
// clang-format on

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "file_bytes.h"

namespace mesh::gltf {

struct Document {
    tinygltf::Model model;     // asset, scene, scenes, nodes, meshes, accessors, views and buffers
    std::vector<Loss> losses;  // what else the file has
    std::vector<std::string> materials;
    std::size_t bytes = 0;  // of the file and of its buffers
};

/// Buffers outside the file are read from `folder`, and as far from it as `reach` allows. Throws BadFile.
Document read_document(std::string_view bytes, const std::filesystem::path& folder, Reach reach);

}  // namespace mesh::gltf
