// Facts that only a model's triangles tell.
#pragma once

#include <memory>
#include <string>

#include "import/framing.h"
#include "import/readers.h"

import candela.geometry;
import candela.plugins;

namespace importing {

struct Geometry {
    candela::Mesh mesh;
    Bounds bounds;  // in the scene, once the model has been moved
    bool has_colors = false, has_uv = false, is_closed = false;
    /// The point of the file's coordinates that becomes the scene's origin, in the format of the shape's
    /// parameter `origin`; empty if the model is not far from its own origin.
    std::string origin{};
    std::shared_ptr<const void> file{};  // keeps the file read until it changes
    Vector moved{};                      // the same point in the scene's axes: subtracted from all positions
};

/// Moves a model far from its origin, as in surveys and maps, to coordinates that single precision can hold.
/// Throws candela::Error.
Geometry geometry_of(const Source& source, bool is_z_up, candela::Registry& registry);

}  // namespace importing
