// Where to look from, and what to light with.
#pragma once

#include <vector>

#include "import/model.h"

namespace importing {

struct Bounds {
    Vector low{}, high{};

    Vector center() const;
    double radius() const;  // of the sphere around it; 1 for a single point
    /// By how much a place may be off without a difference in the picture.
    double tolerance() const;
};

/// From the front, the right and above, as near as the box fits the picture.
Camera camera_for(const Bounds& bounds, double aspect);

/// A key light over the observer's left shoulder, a weaker one from the right, and light from all around.
std::vector<Light> lights_for(const Camera& camera, double brightness);

/// Brings the lights to an exposure at which a white surface is neither black nor burnt out; what they were
/// multiplied with.
double expose(std::vector<Light>& lights, const Bounds& bounds);

/// Moves lights a thousandth of their distance along the line of sight where there is another already, or the
/// camera: a scene has one thing at a place. Whether any has been moved.
bool separate(std::vector<Light>& lights, const Camera& camera, const Bounds& bounds);

/// The extent of a room around the origin that contains all of these: width, height and depth.
Vector room_for(const Bounds& bounds, const Camera& camera, const std::vector<Light>& lights);

}  // namespace importing
