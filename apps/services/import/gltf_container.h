// A glTF file, its buffers and the pictures in it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "import/gltf_json.h"
#include "import/model.h"
#include "import/readers.h"

import candela.util;

namespace importing::gltf {

/// The position of a GLB chunk's bytes in the file; empty if there is no such chunk.
struct Chunk {
    std::uint64_t begin = 0;
    std::size_t size = 0;
};

class Container {
  public:
    /// Reads the JSON of a text or binary file. Reads the bytes of a GLB file, most of which are triangles,
    /// only on request. Throws candela::Error (failure).
    explicit Container(Source source);

    const Json& json() const { return json_; }

    /// An image: a file in the model's folder or below it, or bytes in the model itself. Throws
    /// candela::Error (failure).
    Picture picture(std::size_t image);

    /// All numbers of an accessor with that number of components. Throws candela::Error (failure).
    std::vector<double> values(std::size_t accessor, std::size_t components);

    /// The files named by its buffers and its images, whether or not they exist.
    std::vector<std::filesystem::path> named_files(bool with_images) const;

  private:
    std::string_view buffer(std::size_t index);
    std::string_view view(std::size_t index);
    /// A file next to this one.
    std::filesystem::path part_named(const std::string& uri) const;

    Source source_;
    candela::RegularFile file_;
    Chunk binary_;  // of a GLB file
    Json json_;
    std::map<std::size_t, std::string> buffers_;
};

}  // namespace importing::gltf
