// Shadows of a generated OpenGL program.
#pragma once

#include <string>

#include "candela/target.h"
#include "candela/target/text_template.h"

namespace candela::opengl_target {

/// The parts of the program's templates that concern shadows; empty in a scene without any.
target::Values shadow_values(const ExportedScene& scene);

/// The end of an object's initializer: ", true, false". `is_solid`: as in ExportedMesh.
std::string shadow_members(const ExportedScene& scene, const ExportedObject& object,
                           const ExportedMesh& mesh);

}  // namespace candela::opengl_target
