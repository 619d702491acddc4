// The JSON of a glTF file before tinygltf sees it.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/surface.h"

namespace mesh_io::gltf {

/// Where the bytes of a buffer are.
struct BufferSource {
    bool is_needed = false;            // it concerns triangles; other buffers need not even exist
    std::optional<std::string> uri{};  // none: the file itself contains them
    std::uint64_t length = 0;          // as the file declares it
};

/// A buffer view that EXT_meshopt_compression compresses. The view itself is that of the compressed bytes.
struct CompressedView {
    std::size_t view = 0, count = 0, stride = 0;
    std::string mode{}, filter{};
};

/// A primitive that KHR_draco_mesh_compression compresses, without an uncompressed form. Its accessors tell
/// how to interpret the numbers.
struct DracoPrimitive {
    struct Attribute {
        std::size_t accessor = 0;
        std::uint32_t id = 0;  // in the compressed bytes
    };
    std::size_t mesh = 0, primitive = 0, view = 0;
    std::map<std::string, Attribute> attributes{};
};

/// The accessors of EXT_mesh_gpu_instancing; -1: none.
struct Instances {
    int translation = -1, rotation = -1, scale = -1;
};

struct Skin {
    std::vector<int> joints{};  // nodes; -1: none
    int inverse_matrices = -1;  // an accessor; -1: none
};

struct Geometry {
    std::string json;                    // only what triangles depend on, without buffers
    std::vector<Unsupported> losses;     // everything else in the file
    std::vector<std::string> materials;  // their names, in order; empty where one has none
    std::vector<BufferSource> buffers;
    std::vector<CompressedView> compressed_views;
    std::vector<DracoPrimitive> draco_primitives;
    std::vector<Skin> skins;
    std::vector<bool> is_hidden;                 // per node, with all below it
    std::map<std::size_t, Instances> instances;  // by node
};

/// Refuses text that is not JSON, is nested too deeply, or needs an unsupported extension. `has_binary`:
/// whether the file itself contains the first buffer. Throws BadFile.
Geometry geometry_of(std::string_view json, bool has_binary, Attributes attributes);

/// The second set of texture coordinates.
inline constexpr const char* k_second_uv = "TEXCOORD_1";

}  // namespace mesh_io::gltf
