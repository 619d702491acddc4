// Which pixels of a picture depend on where exactly edges lie.
#pragma once

#include <vector>

import candela.core;

namespace verify {

/// A pixel each, row by row: whether its colour depends on where exactly an edge lies, so that two
/// rasterisers may differ there though both are right. Either it changes, by more than `levels` of 255 on the
/// average of its samples, where they move by an eighth of a pixel; or it is that much apart from the mean
/// of what its samples see, because Candela evaluates light once for each triangle in a pixel. `reference` is
/// the picture of `scene`, 8-bit; the scene is left as it was.
std::vector<bool> edge_pixels(candela::CompiledScene& scene, const candela::Film& reference, float levels);

/// The same as a picture, white where there is an edge.
candela::Film mask_of(const std::vector<bool>& edges, int width, int height);

}  // namespace verify
