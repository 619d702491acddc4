// Moves coordinates far from the origin, such as those of surveys and maps, while they are still doubles.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "surface.h"

namespace mesh {

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

/// Parses three finite numbers separated by blanks or commas; an empty text is the file's own origin. Returns
/// nothing for any other text.
std::optional<Origin> origin_from(std::string_view text);

/// A warning about a surface so far from the origin that its coordinates are visibly rounded, here or in its
/// file; empty for any other.
std::string too_far_note(const Surface& surface, const Origin& origin);

}  // namespace mesh
