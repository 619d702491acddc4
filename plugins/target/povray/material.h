// Materials in POV-Ray's scene language.
#pragma once

#include <cstddef>
#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// Texture statements. The interpolated normal of a visible surface may point away from the observer, as it
/// does near the outline of a coarse closed mesh. POV-Ray then turns it round and shows the interior texture,
/// which is lit from behind: `turned`.
struct Material {
    std::string declarations{};  // before the object
    std::string front;
    std::string turned;
};

/// The material of an object; its texture's pictures become files.
Material material_of(const ExportedScene& scene, std::size_t object, FileSink& files);

/// The material of a vertex whose colour multiplies the object's.
Material material_at_vertex(const ExportedScene& scene, std::size_t object, Vec3 color, FileSink& files);

}  // namespace candela::povray_target
