// When numbers that two builds of one formula give are the same.
#pragma once

#include <algorithm>
#include <cmath>

/// Whether two numbers agree; `largest`: of the vector that the first belongs to. The compiler may join a
/// product and a sum in one build and not in the other, and a large exponent makes much of that.
inline bool agree(float a, float b, float largest) {
    return std::abs(a - b) <= 2e-3f * std::max(std::abs(a), std::abs(b)) + 1e-5f * largest + 1e-7f;
}

/// Where a model has an edge, the last bit decides on which side of it a point is; a wrong formula is wrong
/// nearly everywhere.
inline constexpr double k_may_differ = 0.01;
