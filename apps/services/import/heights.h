// The heights of bump maps, which MTL files have without a unit.
#pragma once

#include "import/geometry.h"
#include "import/model.h"
#include "import/readers.h"

import candela.plugins;

namespace importing {

/// Gives the bump maps of all materials heights in metres: a hundredth of the side of a square in space onto
/// which the picture is mapped on average, times the file's multiplier. So a surface looks the same whatever
/// its unit of length, and however often the picture repeats. Leaves out those that are mapped onto no area.
void measure_heights(Model& model, const Source& source, const Geometry& geometry,
                     candela::Registry& registry);

}  // namespace importing
