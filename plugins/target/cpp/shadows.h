// Shadows of a generated C++ program.
#pragma once

#include <string>

#include "candela/target.h"
#include "candela/target/text_template.h"

namespace candela::cpp_target {

/// Whether objects block any light.
bool casts_shadows(const ExportedScene& scene);
/// Whether they do so at the vertices of the object, where its light is evaluated.
bool lights_vertices(const ExportedScene& scene, const ExportedObject& object);
/// Whether the light's samples vary from pixel to pixel within its extent.
bool has_penumbras(const ExportedScene& scene, const ExportedLight& light);

/// The template's placeholders for shadows; empty if there are none.
target::Values shadow_texts(const ExportedScene& scene);

}  // namespace candela::cpp_target
