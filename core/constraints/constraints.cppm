// What only the placed triangles of a scene can tell (CA Table 1): who is inside the room, and who inside of
// whom.
module;

#include "candela/api.h"

#include <span>

export module candela.constraints;

import candela.diagnostics;
import candela.mesh;
import candela.scene;

export namespace candela {

/// Checks that objects, lights and the observer are inside the room; that no two lights are at one place, nor
/// one at the observer's; that no light and no observer is inside an object; and that objects share no space
/// (touching is allowed). Reports every breach at the place of what breaks it. `meshes`: one an object, in
/// their order; null where an object could not be made, which then is left out.
CANDELA_API void check_constraints(const SceneDraft& draft, std::span<const Mesh* const> meshes,
                                   Diagnostics& diagnostics);

}  // namespace candela
