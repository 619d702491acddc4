// The container of a glTF file: a JSON text, or chunks in a binary file, and URIs in it.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>

#include "mesh_io/array.h"

namespace mesh_io::gltf {

/// Bytes of a file.
struct Range {
    std::size_t begin = 0, size = 0;
};

struct Chunks {
    Range json, binary;
    bool has_binary = false;
};

/// Returns a range of a file's bytes, which lies within its size. They are valid until the next call.
using BytesAt = std::function<std::string_view(std::size_t begin, std::size_t count)>;

/// Where the chunks of a file of `size` bytes are; a file that is not binary is JSON as a whole. Reads only
/// the headers. Throws BadFile.
Chunks chunks_of(std::size_t size, const BytesAt& bytes_at);

/// "a b" of "a%20b".
std::string decoded_percents(std::string_view uri);

/// The content of a data: URI; nothing unless it is valid base64.
std::optional<Array<char>> bytes_of_data_uri(std::string_view uri);

}  // namespace mesh_io::gltf
