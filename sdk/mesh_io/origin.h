// Moves coordinates far from the origin, such as those of surveys and maps, while they are still doubles.
#pragma once

#include <array>
#include <cstddef>

#include "candela/math.h"

namespace mesh_io {

/// The point in a file's coordinates that becomes the origin of object space.
struct Origin {
    std::array<double, 3> at{};

    /// Converts a file's coordinate to object space, rounding only after the move.
    float moved(double coordinate, std::size_t axis) const {
        return static_cast<float>(coordinate - at[axis]);
    }
    candela::Vec3 moved(const std::array<double, 3>& position) const {
        return {moved(position[0], 0), moved(position[1], 1), moved(position[2], 2)};
    }
};

}  // namespace mesh_io
