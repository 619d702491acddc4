// Shapes that form a grid over the parameter square of a surface.
#pragma once

#include <optional>

#include "candela/target.h"

namespace candela::cpp_target {

/// The grid from which a program makes a parametric shape's triangles itself.
struct GridShape {
    int columns = 0, rows = 0;
    bool u_is_periodic = false, v_is_periodic = false, v_ends_in_poles = false;
};

/// The grid that yields these triangles and this sharing of normals; nothing if no grid does.
std::optional<GridShape> grid_of(const ExportedMesh& mesh);

}  // namespace candela::cpp_target
