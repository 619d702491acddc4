// A scene in the form that the page's script reads.
#pragma once

#include "candela/target.h"
#include "candela/target/page_arrays.h"
#include "json.h"

namespace candela::three_target {

/// Adds the arrays that it names to the page. Throws std::runtime_error if the scene cannot be expressed.
Json scene_json(const ExportedScene& scene, target::PageArrays& arrays);

}  // namespace candela::three_target
