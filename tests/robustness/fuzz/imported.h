// Invariants of every imported model.
#pragma once

#include <filesystem>

namespace fuzz {

/// Imports the model: either it is refused with a message, or its scene is valid, and is framed and lit so
/// that all of its constraints hold.
void check_import(const std::filesystem::path& model);

}  // namespace fuzz
