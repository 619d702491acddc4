// The constraints that depend on a scene's triangles (CA Table 1).
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>

export module candela.geometry:constraints;

import candela.api;
import candela.scene;
import candela.util;

export namespace candela {

/// An object's triangles in world space. Non-owning; empty if the object could not be created.
struct SurfaceView {
    ConstVec3Span position;
    std::size_t vertex_count = 0;
    std::span<const std::uint32_t> indices;  // three per triangle, counter-clockwise seen from outside
    bool closed = false;                     // each edge is shared by two triangles

    constexpr bool empty() const { return vertex_count == 0; }
};

/// A light's position, if it has one; ambient and directional lights do not.
CANDELA_EXPORT std::optional<Vec3> position_of(const LightSource& light);

/// Checks that objects, lights and the observer are inside the room; that no two lights share a position, nor
/// a light the observer's; that no light and no observer is inside an object; and that objects do not overlap
/// (they may touch). Reports every violation at the position of its cause. `surfaces`: one per object, in the
/// same order; empty ones are skipped. `checked`, if not empty,
/// is called once for each object.
CANDELA_EXPORT void check_constraints(const SceneDraft& draft, std::span<const SurfaceView> surfaces,
                                      Diagnostics& diagnostics, const std::function<void()>& checked = {});

}  // namespace candela
