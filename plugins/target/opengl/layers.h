// Surfaces of a generated OpenGL program that something may be seen through.
#pragma once

#include "candela/target.h"
#include "candela/target/text_template.h"

namespace candela::opengl_target {

/// The parts of the program's template that concern layers of surfaces.
target::Values layer_values(const ExportedScene& scene);

}  // namespace candela::opengl_target
