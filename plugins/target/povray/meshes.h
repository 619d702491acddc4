// Triangles in POV-Ray's scene language.
#pragma once

#include <cstddef>
#include <string>

#include "candela/target.h"

namespace candela::povray_target {

/// The mesh2 statement of an object, with its material; empty if it has no triangles.
std::string mesh_text(const ExportedScene& scene, std::size_t object, FileSink& files);

}  // namespace candela::povray_target
