// Which pixels of a picture depend on where exactly edges lie.
#pragma once

#include <vector>

import candela.core;

namespace verify {

/// A pixel each, row by row: whether its colour depends on where exactly an edge lies, so that two
/// rasterisers may differ there though both are right: it changes by more than `levels` (of 255) when the
/// picture moves by a sixteenth of a pixel. Where a pixel has several samples, also whether its colour bends
/// within it by more than that, so that light evaluated once in its middle and light evaluated at each sample
/// differ. `reference` is the picture of `scene`, 8-bit; the scene is left as it was.
std::vector<bool> edge_pixels(candela::CompiledScene& scene, const candela::Film& reference, float levels);

/// The same as a picture, white where there is an edge.
candela::Film mask_of(const std::vector<bool>& edges, int width, int height);

}  // namespace verify
