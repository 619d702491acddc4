// The parts of a glTF file that concern triangles, and only those, as read by tinygltf.
#pragma once

// Images are not decoded, and Candela reads the files itself.
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
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "mesh_io/file_bytes.h"
#include "mesh_io/gltf/json.h"

namespace mesh_io::gltf {

/// The bytes of a buffer: its own, or a range of the file's.
struct Buffer {
    Buffer() = default;
    explicit Buffer(Array<char> own) : owned(std::move(own)), bytes(owned.data(), owned.size()) {}
    explicit Buffer(std::string_view of_file) : bytes(of_file) {}
    Buffer(Buffer&&) noexcept = default;  // moved arrays stay where they are
    Buffer& operator=(Buffer&&) noexcept = default;
    Buffer(const Buffer&) = delete;
    Buffer& operator=(const Buffer&) = delete;
    ~Buffer() = default;

    Array<char> owned{};
    std::string_view bytes{};
};

struct Document {
    tinygltf::Model model;  // asset, scene, scenes, nodes, meshes, accessors and views; no buffers
    std::vector<Buffer> buffers;
    std::vector<Skin> skins;
    std::vector<bool> is_hidden;                 // per node
    std::map<std::size_t, Instances> instances;  // by node
    std::vector<Unsupported> losses;             // what the file has besides triangles
    std::vector<std::string> materials;
    std::vector<std::filesystem::path> files;  // of buffers
    std::size_t bytes = 0;                     // of the file and of its buffers

    /// The bytes of a view. Throws BadFile if they are missing.
    std::string_view view(std::size_t index) const;
    /// Adds a buffer and a view of it.
    std::size_t add_view(Array<char> content);
    /// Adds an accessor of `count` contiguous elements: TINYGLTF_COMPONENT_TYPE_..., TINYGLTF_TYPE_...
    int add_accessor(Array<char> content, int component_type, int type, std::size_t count);
};

/// Reads buffers outside the file from `folder`, and from elsewhere if `reach` allows; decompresses
/// compressed data. The document refers to `bytes`. Throws BadFile.
Document read_document(std::string_view bytes, const std::filesystem::path& folder, FileScope reach,
                       Attributes attributes);

}  // namespace mesh_io::gltf
