// Handles the numbers of a file that are not finite.
#pragma once

#include <string_view>

#include "mesh_io/surface.h"

namespace mesh_io {

/// Throws BadFile naming the first triangle (`face`, in the file's terms) with a position that is not finite.
/// A vertex that no triangle uses, as scanners write where they saw nothing, is moved to a finite one;
/// normals and texture coordinates that are not finite become zero, with a note that counts them.
void require_finite(Surface& surface, std::string_view face);

}  // namespace mesh_io
