// Compares two pictures with candela-diff.
#pragma once

#include <filesystem>

#include "compare/comparison.h"

namespace verify {

/// Runs `candela diff` on two pictures and returns its result, with the pixels that are white in `edges`
/// counted apart. Writes the picture of the differences to `heat_map`. Writes picture `b`, as PPM, to
/// `decoded`, even if the pictures differ in size, which is an error. `program`: the program that runs the
/// verb. Throws candela::Error.
Comparison compare(const std::filesystem::path& program, const std::filesystem::path& a,
                   const std::filesystem::path& b, const std::filesystem::path& edges,
                   const std::filesystem::path& heat_map, const std::filesystem::path& decoded);

}  // namespace verify
