// What lights send, over the angle with their axis and over the distance.
#pragma once

#include <string>
#include <vector>

#include "named_model.h"

import candela.registry;

/// A place that the light shines on, which faces it, and the intensity that arrives there: what all samples
/// of the light send, as luminance (Rec. 709).
struct LightPoint {
    double at = 0;  // degrees from the light's axis, or metres
    double intensity = 0;
};

/// All lights at the same places.
struct LightCurves {
    std::string label;
    std::vector<LightPoint> by_angle;     // one metre away, from the axis on, for every half degree up to 90
    std::vector<LightPoint> by_distance;  // on the axis, 0.1 m to 10 m, twenty per power of ten
};

/// A light without a direction has an axis that points down; one without a place is where the axis begins.
/// Throws candela::Error (bad_request) for what is wrong with the light, and for one that sends the same
/// everywhere.
LightCurves light_curves_of(const NamedModel& light, candela::Registry& registry);

/// A table: "angle" or "distance", where, and what each light sends there.
std::string light_curves_csv(const std::vector<LightCurves>& lights);

/// Two diagrams side by side: over the angle as a share of what is sent along the axis, and over the
/// distance, both axes logarithmic.
std::string light_curves_svg(const std::vector<LightCurves>& lights);
