// Finds the other files that a model's file names.
#pragma once

#include <filesystem>

namespace importing {

/// Whether `file`, which exists, is read when `model` is imported: a buffer of a glTF file, a material
/// library, or a picture named by one. It may be reached by a link. False if `model` is not a model.
bool is_part_of(const std::filesystem::path& model, const std::filesystem::path& file);

}  // namespace importing
