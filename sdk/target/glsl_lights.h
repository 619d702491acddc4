// The part of a scene's shaders that adds up the light at a point.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::target {

/// GlslParts::lights.
std::string lights_text(const ExportedScene& scene);

}  // namespace candela::target
