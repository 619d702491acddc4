// The light emitted by lights, over the angle with their axis and over the distance.
#pragma once

#include <string>
#include <vector>

#include "plot/model_argument.h"

import candela.plugins;

/// A point that faces the light, and the intensity that arrives there: the sum of all the light's samples, as
/// luminance (Rec. 709).
struct LightPoint {
    double at = 0;  // degrees from the light's axis, or metres
    double intensity = 0;
};

/// All lights are sampled at the same points.
struct LightCurves {
    std::string label;
    std::vector<LightPoint> by_angle;     // one metre away, from the axis on, for every half degree up to 90
    std::vector<LightPoint> by_distance;  // on the axis, 0.1 m to 10 m, twenty per power of ten
};

/// A light without a direction gets an axis that points down; one without a position is at the start of the
/// axis. Throws candela::Error (bad_request) for invalid parameters, and for a light that emits the same
/// everywhere.
LightCurves light_curves_of(const NamedModel& light, candela::Registry& registry);

/// A table: "angle" or "distance", its value, and each light's intensity there.
std::string light_curves_csv(const std::vector<LightCurves>& lights);

/// Two diagrams side by side: over the angle, relative to the axis, and over the distance, with both axes
/// logarithmic.
std::string light_curves_svg(const std::vector<LightCurves>& lights);
