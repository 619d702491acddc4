// A glTF file, its buffers and the pictures in it.
#pragma once

#include <cstddef>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "import/model.h"
#include "import/readers.h"
#include "mesh_io/array.h"
#include "mesh_io/file_bytes.h"
#include "mesh_io/gltf/container.h"
#include "mesh_io/gltf/values.h"

namespace importing::gltf {

using mesh_io::gltf::array_of;
using mesh_io::gltf::element;
using mesh_io::gltf::find;
using mesh_io::gltf::index_of;
using mesh_io::gltf::Json;
using mesh_io::gltf::number;
using mesh_io::gltf::numbers;
using mesh_io::gltf::object_of;
using mesh_io::gltf::text_of;

class Container {
  public:
    /// Reads the JSON of a text or binary file. Reads the bytes of a GLB file, most of which are triangles,
    /// only on request. Throws candela::Error (failure).
    explicit Container(const Source& source);

    const Json& json() const { return json_; }

    /// An image: a file in the model's folder or below it, or bytes in the model itself. Throws
    /// candela::Error (failure).
    Image image(std::size_t index);

    /// All numbers of an accessor with that number of components. Throws candela::Error (failure).
    std::vector<double> values(std::size_t accessor, std::size_t components);

  private:
    std::string_view buffer(std::size_t index);
    mesh_io::Array<char> read_buffer(std::size_t index);
    std::string_view view(std::size_t index);
    /// A file next to this one.
    std::filesystem::path part_named(const std::string& uri) const;

    Source source_;
    mesh_io::Pieces file_;
    mesh_io::gltf::Chunks chunks_;
    Json json_;
    std::map<std::size_t, mesh_io::Array<char>> buffers_;
};

}  // namespace importing::gltf
