// Coordinates far from the origin, such as those of surveys and maps: where they enter, they are still
// doubles.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <string_view>

#include "surface.h"

namespace mesh {

/// The point of a file's coordinates that becomes the origin of object space.
struct Origin {
    std::array<double, 3> at{};

    /// A coordinate of the file in object space, rounded only after it has been moved.
    float moved(double coordinate, std::size_t axis) const {
        return static_cast<float>(coordinate - at[axis]);
    }
    candela::Vec3 moved(const std::array<double, 3>& position) const {
        return {moved(position[0], 0), moved(position[1], 1), moved(position[2], 2)};
    }
};

/// From three finite numbers with blanks or commas between them; an empty text is the file's own origin.
/// Nothing for any other text.
std::optional<Origin> origin_from(std::string_view text);

/// What to say about a surface that lies so far from the origin that its coordinates are visibly rounded,
/// here or in its file; empty for any other.
std::string too_far_note(const Surface& surface, const Origin& origin);

}  // namespace mesh
