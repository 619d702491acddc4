// Light from one direction as reflected by reflection models, in the plane of incidence.
#pragma once

#include <string>
#include <vector>

#include "plot/model_argument.h"

import candela.plugins;

/// A direction towards the observer, and the intensity that a white surface reflects there from a light of
/// intensity 1: the model's contribution to I_d and I_s, as luminance (Rec. 709).
struct LobePoint {
    double angle = 0;  // degrees from the normal; positive on the side of the mirror direction
    double diffuse = 0;
    double specular = 0;

    double intensity() const { return diffuse + specular; }
};

struct Lobe {
    std::string label;
    std::vector<LobePoint> points;  // sorted by angle; the same angles for all lobes

    double peak() const;
};

/// The lobe of light arriving at `incidence` degrees from the normal. Throws candela::Error for invalid
/// parameters of the model.
Lobe lobe_of(const NamedModel& model, double incidence, candela::Registry& registry);

struct Match {
    double value = 0;
    double error = 0;  // root mean square of the difference, relative to the target's peak
};

/// The value of a parameter of `model` that brings its lobe nearest to `target`, by least squares over the
/// angles. Throws candela::Error (bad_request) if the model has no such parameter, or it is not a number.
Match match_lobe(const Lobe& target, const NamedModel& model, const std::string& parameter, double incidence,
                 candela::Registry& registry);
