// What only the placed triangles of a scene can tell (CA Table 1): who is inside the room, and who inside of
// whom.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <span>

export module candela.constraints;

import candela.diagnostics;
import candela.math;
import candela.scene;

export namespace candela {

/// An object's triangles in world space. Owns nothing; empty where the object could not be made.
struct SurfaceView {
    ConstVec3Span position;
    std::size_t vertex_count = 0;
    std::span<const std::uint32_t> indices;  // three vertices a triangle, counter-clockwise seen from outside
    bool closed = false;                     // each edge lies between two triangles

    constexpr bool empty() const { return vertex_count == 0; }
};

/// Checks that objects, lights and the observer are inside the room; that no two lights are at one place, nor
/// one at the observer's; that no light and no observer is inside an object; and that objects share no space
/// (touching is allowed). Reports every breach at the place of what breaks it. `surfaces`: one per object, in
/// their order; empty ones are left out.
CANDELA_API void check_constraints(const SceneDraft& draft, std::span<const SurfaceView> surfaces,
                                   Diagnostics& diagnostics);

}  // namespace candela
