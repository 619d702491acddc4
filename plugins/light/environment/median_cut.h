// Light samples chosen from an equirectangular picture (Debevec 2005).
#pragma once

#include <vector>

#include "candela/math.h"
#include "candela/picture.h"

namespace candela::environment_light {

/// The largest number of samples is 2 to this power.
constexpr int k_levels = 10;

/// An equirectangular picture at a direction: its centre is the view along -z, its right half is towards +x,
/// its top row +y.
Vec3 seen(const Picture& picture, Vec3 towards);

/// For each level k from 0 to k_levels, 2^k samples, six numbers each: a unit vector, and the integral of the
/// intensity over the sample's region, divided by pi.
std::vector<float> median_cut(const Picture& picture);

}  // namespace candela::environment_light
