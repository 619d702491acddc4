// Lights in POV-Ray's scene language.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// The sum of all ambient light.
Vec3 ambient_of(const ExportedScene& scene);

/// The light_source statements, except for lights that cast no shadows.
std::string lights_text(const ExportedScene& scene, FileSink& files);

/// The lights in an object's light_group, which reach it whatever is in the way: all of them, or those that
/// cast no shadows. `shell`: the name of the object's shell_of().
std::string unblocked_lights_text(const ExportedScene& scene, const std::string& shell, bool are_all,
                                  FileSink& files);

}  // namespace candela::povray_target
