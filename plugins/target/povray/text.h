// Numbers of POV-Ray's scene language.
#pragma once

#include <string>

#include "candela/math.h"
#include "candela/target/renderers.h"

namespace candela::povray_target {

/// "<0, 1.5, 4>", with the fewest digits that are exact.
std::string vector_text(Vec3 v);
std::string vector_text(const target::Vector& v);
/// "rgb 0.5" or "rgb <1, 0.5, 0>".
std::string rgb_text(Vec3 color);

inline bool is_grey(Vec3 color) { return color.x == color.y && color.y == color.z; }

}  // namespace candela::povray_target
