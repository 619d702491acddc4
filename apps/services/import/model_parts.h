// Finds the other files that a model's file names.
#pragma once

#include <filesystem>

namespace importing {

/// Whether `file`, which exists, is read together with a model's triangles: a buffer of a glTF file. It may
/// be reached by a link. False if `model` is not a model.
bool is_buffer_of(const std::filesystem::path& model, const std::filesystem::path& file);

/// Whether it is read when the model is imported: also a material library, or a picture named by one.
bool is_part_of(const std::filesystem::path& model, const std::filesystem::path& file);

}  // namespace importing
