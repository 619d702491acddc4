// Chooses the camera and the lights.
#pragma once

#include <vector>

#include "import/model.h"

namespace importing {

struct Bounds {
    Vector low{}, high{};

    Vector center() const;
    double radius() const;  // of the sphere around it; 1 for a single point
    /// The largest error of a position that makes no difference in the picture.
    double tolerance() const;
};

/// Looks from the front, the right and above, with the box filling the picture.
Camera camera_for(const Bounds& bounds, double aspect);

/// A key light over the observer's left shoulder, a weaker one from the right, and light from all around.
std::vector<Light> lights_for(const Camera& camera, double brightness);

/// The built-in studio, its front towards the observer.
Light studio_for(const Camera& camera, double brightness);

/// For surfaces with Phong's highlights, which hardly show light from everywhere: a dimmer studio, with a key
/// light for the highlights and ambient light for the materials' own share of it.
std::vector<Light> studio_with_key_for(const Camera& camera, double brightness);

/// The factor by which an exposure multiplies the lights' luminances so that a white surface is neither black
/// nor burnt out; 1 if it is neither without.
double exposure_for(const std::vector<Light>& lights, const Bounds& bounds);

/// Moves each light that shares its position with another or with the camera along the line of sight, by a
/// thousandth of its distance: a scene allows only one thing at a position. Returns whether any was moved.
bool separate(std::vector<Light>& lights, const Camera& camera, const Bounds& bounds);

/// The extent of a room around the origin that contains all of these: width, height and depth.
Vector room_for(const Bounds& bounds, const Camera& camera, const std::vector<Light>& lights);

}  // namespace importing
