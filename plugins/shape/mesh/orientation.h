// Which side of a mesh is outside.
#pragma once

#include "corners.h"
#include "surface.h"

namespace mesh {

/// Turns round each closed part that encloses a negative volume, with all that is inside it: its triangles,
/// and its normals where they were meant for the other side. A part is what triangles connect; one inside
/// another is a cavity, whichever way it is wound. Says in `surface.notes` how many there were; returns
/// whether there were any, since their corners then lie elsewhere.
bool turn_outwards(Surface& surface, const Corners& corners, const OpenEdges& open);

}  // namespace mesh
