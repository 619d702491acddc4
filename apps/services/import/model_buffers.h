// Finds the buffers of models, which no output may replace.
#pragma once

#include <filesystem>
#include <string_view>

#include "mesh_io/file_bytes.h"
#include "mesh_io/gltf/container.h"
#include "mesh_io/gltf/values.h"

namespace importing {

/// Whether `file`, which exists, is read together with a model's triangles: a buffer of a glTF file. It may
/// be reached by a link. False if `model` is not a model.
bool is_buffer_of(const std::filesystem::path& model, const std::filesystem::path& file);

/// Whether two words are the same but for the case of ASCII letters.
bool is_same_word(std::string_view a, std::string_view b);

/// Whether a model that names `named` means `file`, which exists. Readers may ignore case when they look for
/// a name, so names in another case count as the same file.
bool is_file(const std::filesystem::path& named, const std::filesystem::path& file);

namespace gltf {

struct Head {
    mesh_io::gltf::Chunks chunks;
    mesh_io::gltf::Json json;
};

/// The JSON of a text or binary file. Throws mesh_io::BadFile.
Head head_of(mesh_io::Pieces& file);

enum class Named : bool { buffers, buffers_and_images };

/// Whether a glTF file names `file` as one of its parts. False if it cannot be read: its reader will report
/// the error.
bool is_named(const std::filesystem::path& model, const std::filesystem::path& file, Named parts);

}  // namespace gltf

}  // namespace importing
