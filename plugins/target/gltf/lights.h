// Lights in the form of KHR_lights_punctual.
#pragma once

#include "candela/target.h"
#include "document.h"

namespace candela::gltf_target {

/// Adds all lights, and appends the index of each one's node to `nodes`.
void add_lights(const ExportedScene& scene, Document& document, Json& nodes, FileSink& files);

}  // namespace candela::gltf_target
