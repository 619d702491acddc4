// Positions, rotations and scales.
#pragma once

#include "import/model.h"
#include "import/vectors.h"

namespace importing {

inline Placement within(const Placement& a, const Placement& b) {
    return {a.direction(b.x), a.direction(b.y), a.direction(b.z), a.point(b.origin)};
}

inline double determinant(const Placement& p) { return dot(p.x, cross(p.y, p.z)); }

/// The inverse of a placement whose determinant is not zero.
inline Placement inverse(const Placement& p) {
    const double factor = 1 / determinant(p);
    const Vector a = factor * cross(p.y, p.z), b = factor * cross(p.z, p.x), c = factor * cross(p.x, p.y);
    const Placement linear{{a[0], b[0], c[0]}, {a[1], b[1], c[1]}, {a[2], b[2], c[2]}, {}};
    return {linear.x, linear.y, linear.z, -1 * linear.direction(p.origin)};
}

}  // namespace importing
