// Lights in POV-Ray's scene language.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// The sum of all ambient light.
Vec3 ambient_of(const ExportedScene& scene);

/// All light_source statements.
std::string lights_text(const ExportedScene& scene, FileSink& files);

}  // namespace candela::povray_target
