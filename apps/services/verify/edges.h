// Finds the pixels of a picture that depend on the exact positions of edges.
#pragma once

#include <vector>

import candela.render;

namespace verify {

/// How a picture depends on exact positions. One value per pixel, or three for red, green and blue, row by
/// row.
struct Sensitivity {
    /// Whether a pixel's colour depends on the exact position of an edge or a step, so that two rasterisers
    /// may differ there although both are correct.
    std::vector<bool> edges;
    /// The growth of a channel, in levels (1/255), when the observed point moves by a pixel to the right, or
    /// down.
    std::vector<float> right, down;
};

/// The smallest change that makes a pixel an edge, if a pixel may differ by `tolerance` levels: half of that,
/// but at least one, because a tolerance of 0 would leave only edges.
constexpr float edge_levels(double tolerance) {
    constexpr double k_floor = 1;
    return static_cast<float>(tolerance / 2 < k_floor ? k_floor : tolerance / 2);
}

/// A pixel is an edge if it changes, averaged over its samples, by more than `levels` (1/255) when they move
/// by an eighth of a pixel, or when light arrives from a direction that differs by 0.0002 radians. It is also
/// an edge if it differs by that much from the mean over its samples, because Candela evaluates light once
/// for each triangle in a pixel. `reference` is the 8-bit picture of `scene`; the scene is left unchanged.
Sensitivity sensitivity_of(candela::RenderScene& scene, const candela::Film& reference, float levels);

/// Candela's picture before rounding: 0 to 255, encoded as in a file.
std::vector<float> unrounded_image(const candela::RenderScene& scene);

/// Edges as a picture, with white for edges.
candela::Film mask_of(const std::vector<bool>& edges, int width, int height);

}  // namespace verify
