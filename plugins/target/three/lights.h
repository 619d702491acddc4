// Lights in the form of three.js.
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

/// The scene's lights as three.js's own, for its own diffuse materials; nothing if it lacks one of them, in
/// which case kernels light all objects, as they do in a scene with shadows, since three.js's are maps of
/// depths, whose pixels one sees, and in one with opacity, whose layers three.js's materials do not peel.
/// `boxes`: the lit objects, since three.js's lights do not fade within a tenth of a metre.
std::optional<Json> own_lights(const ExportedScene& scene, const std::vector<Box>& boxes);

}  // namespace candela::three_target
