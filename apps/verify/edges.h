// Which pixels of a picture depend on where exactly edges lie.
#pragma once

#include <vector>

import candela.core;

namespace verify {

/// A pixel each, row by row: whether the picture changes there by more than `levels` (of 255) when it is
/// moved by a sixteenth of a pixel to any side. Two rasterisers may differ in such pixels though both are
/// right; in all others they may not. `reference` is the picture of `scene`, 8-bit. The scene is left as it
/// was, its observer moves meanwhile.
std::vector<bool> edge_pixels(candela::CompiledScene& scene, const candela::Film& reference, float levels);

/// The same as a picture, white where there is an edge.
candela::Film mask_of(const std::vector<bool>& edges, int width, int height);

}  // namespace verify
