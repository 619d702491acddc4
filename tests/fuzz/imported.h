// What holds of every model that is imported.
#pragma once

#include <filesystem>

namespace fuzz {

/// Imports the model: either it is refused in words, or its scene is valid, and is framed and lit so that all
/// of its constraints hold.
void check_import(const std::filesystem::path& model);

}  // namespace fuzz
