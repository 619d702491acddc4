// What a scene is compared with: itself, with other models and other values.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "command_line.h"

import candela.scene;

/// One value of one axis: "phong", "reflection.shininess=8".
struct Variant {
    std::string label;
    std::string option;  // "--reflection", "--terms", or the path that is set
    std::string value;
};

/// The variants along one side of a sheet.
using Axis = std::vector<Variant>;

/// Adds --vary and --terms; --reflection and --shading take lists here.
void add_variant_options(CommandLine& line);

/// The axes that the options name, those with one value included, in the order reflection, shading, values,
/// terms.
/// Throws candela::Error (bad_request) for an empty list, a repeated value, and more than two axes with
/// several values.
std::vector<Axis> axes_from(const CommandLine& line);

/// One variant of each axis, for all of them: the last axis varies slowest.
std::vector<std::vector<Variant>> combinations(const std::vector<Axis>& axes);

/// `request` with those variants; terms are no matter of the scene's.
candela::SceneRequest varied(candela::SceneRequest request, const std::vector<Variant>& variants);

/// "phong, flat": the labels of those axes that have several values.
std::string label_of(const std::vector<Axis>& axes, const std::vector<Variant>& variants);
