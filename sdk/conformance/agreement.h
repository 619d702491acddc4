// When the numbers of two builds of one formula count as equal.
#pragma once

#include <algorithm>
#include <cmath>

/// Whether two numbers agree; `largest`: the largest component of the vector that contains the first. The
/// compiler may fuse a product and a sum in one build and not in the other, and a large exponent amplifies
/// the difference.
inline bool agree(float a, float b, float largest) {
    return std::abs(a - b) <= 2e-3f * std::max(std::abs(a), std::abs(b)) + 1e-5f * largest + 1e-7f;
}

/// At a discontinuity of a model, the last bit decides on which side a point is; a wrong formula is wrong
/// nearly everywhere.
inline constexpr double k_may_differ = 0.01;
