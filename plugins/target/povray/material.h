// Materials in POV-Ray's scene language.
#pragma once

#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// The texture of an object. `turns_away`: the interpolated normal of a surface that is seen may point away
/// from the observer, as it does near the outline of a coarse closed mesh. POV-Ray turns it around then, and
/// shows the interior texture, which is one that is lit from behind.
std::string material_text(const ExportedScene& scene, const ExportedObject& object, bool turns_away,
                          FileSink& files);

}  // namespace candela::povray_target
