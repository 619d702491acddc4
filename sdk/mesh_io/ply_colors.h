// Colours of PLY files, which neither declare their largest value nor always use that of their type.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "mesh_io/ply_header.h"
#include "mesh_io/surface.h"

namespace mesh_io::ply {

/// Divides channels of that type by the value of the brightest colour: 255 for bytes, otherwise what their
/// largest value suggests. If that is not the largest value of the type (1 for floats), adds a note about
/// `whose` ("vertex") colours.
void scale_colors(std::initializer_list<Array<float>*> channels, Type type, std::string_view whose,
                  std::vector<std::string>& notes);

}  // namespace mesh_io::ply
