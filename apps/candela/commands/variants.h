// The variants of a scene to compare: other models and other values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"

import candela.scene;

/// One value of one axis: "phong", "reflection.shininess=8".
struct Variant {
    std::string label;
    std::string option;  // "--reflection", "--terms", or the path to set
    std::string value;
};

/// The variants along one side of a sheet.
using Axis = std::vector<Variant>;

/// Adds --vary and --terms; --reflection and --shading take lists here.
void add_variant_options(CommandLine& line);

/// The axes that the options name, including those with one value, in the order reflection, shading, values,
/// terms. Throws candela::Error (bad_request) for an empty list, a repeated value, or more than two axes with
/// several values.
std::vector<Axis> axes_from(const CommandLine& line);

/// All combinations of one variant per axis: the last axis varies slowest.
std::vector<std::vector<Variant>> combinations(const std::vector<Axis>& axes);

/// `request` with those variants; terms do not change the scene.
candela::SceneRequest varied(candela::SceneRequest request, const std::vector<Variant>& variants);

/// "phong, flat": the labels of the axes with several values.
std::string label_of(const std::vector<Axis>& axes, const std::vector<Variant>& variants);
