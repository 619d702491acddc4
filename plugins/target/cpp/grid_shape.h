// Shapes that are a grid over the parameter square of a surface.
#pragma once

#include <optional>

#include "candela/target.h"

namespace candela::cpp_target {

/// What a program needs to make a parametric shape's triangles itself.
struct GridShape {
    int columns = 0, rows = 0;
    bool u_is_periodic = false, v_is_periodic = false, v_ends_in_poles = false;
};

/// The grid whose triangles, and whose sharing of normals, these are; nothing where they are of no grid.
std::optional<GridShape> grid_of(const ExportedMesh& mesh);

}  // namespace candela::cpp_target
