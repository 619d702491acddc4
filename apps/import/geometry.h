// What only a model's triangles tell.
#pragma once

#include <memory>
#include <string>

#include "import/framing.h"
#include "import/readers.h"

import candela.mesh;
import candela.registry;

namespace importing {

struct Geometry {
    candela::Mesh mesh;
    Bounds bounds;  // in the scene, once the model has been moved
    bool has_colors = false, has_uv = false, is_closed = false;
    /// The point of the file's coordinates that becomes the scene's origin, as the shape's parameter `origin`
    /// has it; empty where the model is not far from its own.
    std::string origin{};
    std::shared_ptr<const void> file{};  // read, until this is gone or the file changes
    Vector moved{};  // the same point in the scene's directions: what has been subtracted from all positions
};

/// Of a model far from its origin, as surveys and maps have them, the coordinates are moved to where single
/// precision holds them. Throws candela::Error.
Geometry geometry_of(const Source& source, bool is_z_up, candela::Registry& registry);

}  // namespace importing
