// Lights as three.js has them.
#pragma once

#include <optional>
#include <vector>

#include "candela/target.h"
#include "json.h"

namespace candela::three_target {

/// The box around an object's triangles, in metres.
struct Box {
    Vec3 low{}, high{};
};

/// The scene's lights as three.js's own, for its own diffuse materials, or nothing where it does not have one
/// of them: then all objects are lit by kernels. `boxes`: what the lights shine on, since three.js's fade no
/// more within a tenth of a metre.
std::optional<Json> own_lights(const ExportedScene& scene, const std::vector<Box>& boxes);

}  // namespace candela::three_target
