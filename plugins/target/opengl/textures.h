// Textures of a generated OpenGL program.
#pragma once

#include <string>

#include "candela/target.h"
#include "candela/target/text_template.h"

namespace candela::opengl_target {

/// The parts of the program's template that concern textures; empty in a scene without any. `shader`:
/// GlslParts::texture.
target::Values texture_values(const ExportedScene& scene, const std::string& shader);

/// The end of an object's initializer: ", 0, true".
std::string texture_members(const ExportedScene& scene, const ExportedObject& object);

}  // namespace candela::opengl_target
