// How two pictures differ, by the program that knows their files.
#pragma once

#include <filesystem>

#include "picture_comparison/comparison.h"

namespace verify {

/// What `candela diff` says of two pictures, pixels apart that are white in `edges`; writes the picture of
/// the differences to `heat_map`, and what was read of `b`, as PPM, to `decoded`, also where the pictures
/// differ in size, which is an error. `program`: the program behind that verb. Throws candela::Error.
Comparison compare(const std::filesystem::path& program, const std::filesystem::path& a,
                   const std::filesystem::path& b, const std::filesystem::path& edges,
                   const std::filesystem::path& heat_map, const std::filesystem::path& decoded);

}  // namespace verify
