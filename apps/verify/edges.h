// Which pixels of a picture depend on where exactly edges lie.
#pragma once

#include <vector>

import candela.film;
import candela.render;

namespace verify {

/// What a picture owes to where exactly things lie in it. A pixel each, or its red, green and blue, row by
/// row.
struct Sensitivity {
    /// Whether a pixel's colour depends on where exactly an edge or a step lies, so that two rasterisers may
    /// differ there though both are right.
    std::vector<bool> edges;
    /// By how many of 255 levels a channel grows where the observed place moves by a pixel to the right, or
    /// down.
    std::vector<float> right, down;
};

/// From which change on a pixel is an edge, where a pixel may differ by `tolerance` levels: half of that, but
/// never less than one, or a tolerance of 0 would leave no pixel that is not an edge.
constexpr float edge_levels(double tolerance) {
    constexpr double k_floor = 1;
    return static_cast<float>(tolerance / 2 < k_floor ? k_floor : tolerance / 2);
}

/// A pixel is an edge that changes, by more than `levels` of 255 on the average of its samples, where they
/// move by an eighth of a pixel, or where light comes from a direction that differs by 0.0002 radians; or
/// that is that much apart from the mean of what its samples see, because Candela evaluates light once for
/// each triangle in a pixel. `reference` is the picture of `scene`, 8-bit; the scene is left as it was.
Sensitivity sensitivity_of(candela::CompiledScene& scene, const candela::Film& reference, float levels);

/// Candela's picture before it is rounded: 0 to 255, encoded as in a file.
std::vector<float> unrounded_picture(const candela::CompiledScene& scene);

/// Edges as a picture, white where there is one.
candela::Film mask_of(const std::vector<bool>& edges, int width, int height);

}  // namespace verify
