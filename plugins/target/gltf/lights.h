// Lights as KHR_lights_punctual has them.
#pragma once

#include "candela/target.h"
#include "document.h"

namespace candela::gltf_target {

/// Adds all lights, and to `nodes` the index of a node of each.
void add_lights(const ExportedScene& scene, Document& document, Json& nodes, FileSink& files);

}  // namespace candela::gltf_target
