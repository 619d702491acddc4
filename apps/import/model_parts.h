// Which other files a model's file names.
#pragma once

#include <filesystem>

namespace importing {

/// Whether `file`, which exists, is read with a model's triangles: a buffer of a glTF file. It may be named
/// by a link. False for what is not a model.
bool is_buffer_of(const std::filesystem::path& model, const std::filesystem::path& file);

/// Whether it is read when the model is imported: also a material library, or a picture that one names.
bool is_part_of(const std::filesystem::path& model, const std::filesystem::path& file);

}  // namespace importing
