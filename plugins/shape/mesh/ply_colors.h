// Colours of PLY files, which say neither what their largest value is nor that it is that of their type.
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

#include "ply_header.h"
#include "surface.h"

namespace mesh::ply {

/// Divides channels, which have that type, by what stands for the brightest: 255 for bytes, and otherwise
/// what their largest value suggests, which is said in `notes`, as of `whose` ("vertex") colours, where it is
/// not the largest of the type (of floats: 1).
void scale_colors(std::initializer_list<Array<float>*> channels, Type type, std::string_view whose,
                  std::vector<std::string>& notes);

}  // namespace mesh::ply
