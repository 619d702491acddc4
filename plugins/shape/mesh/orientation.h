// Finds out which side of a mesh is outside.
#pragma once

#include "corners.h"
#include "mesh_io/surface.h"

namespace mesh {

/// Turns round each closed part that encloses a negative volume, with everything inside it: its triangles,
/// and its normals if they point inwards. A part is a set of connected triangles; one inside another is a
/// cavity, whichever way it is wound. Adds their number to `surface.notes`; returns whether there were any,
/// since their corners have then moved.
bool turn_outwards(mesh_io::Surface& surface, const Corners& corners, const OpenEdges& open);

}  // namespace mesh
