// A part of a surface: the triangles of one material.
#pragma once

#include <string_view>

#include "surface.h"

namespace mesh {

/// Keeps the triangles whose material has that name, or that number: "#0". Throws BadFile, which names those
/// there are, if there are none.
void keep_part(Surface& surface, std::string_view part);

}  // namespace mesh
