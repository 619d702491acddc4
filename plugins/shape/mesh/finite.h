// What in a file is not a finite number.
#pragma once

#include <string_view>

#include "surface.h"

namespace mesh {

/// Throws BadFile that names the first triangle (`face`, in the file's word) with a position that is not
/// finite. A vertex that no triangle has, as scanners write where they saw nothing, is moved to one that is
/// finite; normals and texture coordinates that are not finite become zero, with a note that counts them.
void require_finite(Surface& surface, std::string_view face);

}  // namespace mesh
