// Shadows in POV-Ray's scene language.
#pragma once

#include <cstddef>

#include "candela/target.h"

namespace candela::povray_target {

/// Whether light reaches an object although something is in the way.
bool has_unblocked_lights(const ExportedScene& scene, const ExportedObject& object);

/// Declares what is approximate in the shadows of the lights, and in those on an object.
void approximate_shadows(const ExportedScene& scene, FileSink& files);
void approximate_shadows(const ExportedScene& scene, std::size_t object, const ExportedMesh& mesh,
                         FileSink& files);

}  // namespace candela::povray_target
