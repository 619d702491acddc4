// The parameter `origin`, for coordinates far from the origin, such as those of surveys and maps.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "mesh_io/origin.h"
#include "mesh_io/surface.h"

namespace mesh {

/// Parses three finite numbers separated by blanks or commas; an empty text is the file's own origin. Returns
/// nothing for any other text.
std::optional<mesh_io::Origin> origin_from(std::string_view text);

/// A warning about a surface so far from the origin that its coordinates are visibly rounded, here or in its
/// file; empty for any other.
std::string too_far_note(const mesh_io::Surface& surface, const mesh_io::Origin& origin);

}  // namespace mesh
