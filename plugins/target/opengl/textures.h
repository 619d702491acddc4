// Textures of a generated OpenGL program.
#pragma once

#include <cstddef>
#include <string>

#include "candela/target.h"
#include "candela/target/glsl.h"
#include "candela/target/text_template.h"

namespace candela::opengl_target {

/// The parts of the program's template that concern textures; empty in a scene without any.
target::Values texture_values(const ExportedScene& scene, const target::GlslParts& glsl);

/// The end of object number `index`'s initializer: ", 0, -1, -1, {{2, true}}".
std::string texture_members(const ExportedScene& scene, std::size_t index);

}  // namespace candela::opengl_target
