// A scene as the page's script reads it.
#pragma once

#include "candela/target.h"
#include "candela/target/page_arrays.h"
#include "json.h"

namespace candela::three_target {

/// The arrays that it names are put where they belong. Throws std::runtime_error where it cannot be
/// expressed.
Json scene_json(const ExportedScene& scene, target::PageArrays& arrays);

}  // namespace candela::three_target
