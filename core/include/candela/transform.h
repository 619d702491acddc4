#pragma once

#include "candela/math.h"

namespace candela {

/// Position, orientation and size of an object: scaled (by more than zero), then rotated about x, then y,
/// then z (fixed axes, degrees), then translated.
struct Transform {
    Vec3 position{};
    Vec3 rotation{};
    Vec3 scale{1, 1, 1};

    friend constexpr bool operator==(const Transform&, const Transform&) = default;
};

enum class Projection : int { perspective, orthographic };

}  // namespace candela
