// Martin Newell's teapot (Newell 1975, The utilization of procedure models in digital image synthesis,
// University of Utah), with the bottom that was added later: 32 bicubic Bezier patches. The original's units
// and axes: z up, 3.15 high.
#pragma once

#include <array>
#include <vector>

#include "candela/math.h"

namespace teapot {

/// Control points, rows along v, columns along u; dpdu x dpdv points outwards.
using Patch = std::array<std::array<candela::Vec3, 4>, 4>;

/// All 32 patches, y up, resting on y = 0. Adjacent patches share their boundary's control points to the last
/// bit.
std::vector<Patch> patches();

inline constexpr float k_height = 3.15f;

}  // namespace teapot
