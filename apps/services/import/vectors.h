// Vectors in double precision, for the coordinates of models.
#pragma once

#include <cmath>

#include "import/model.h"

namespace importing {

inline Vector operator+(Vector a, Vector b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
inline Vector operator-(Vector a, Vector b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
inline Vector operator*(double s, Vector a) { return {s * a[0], s * a[1], s * a[2]}; }
inline double dot(Vector a, Vector b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
inline Vector cross(Vector a, Vector b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}
inline double length(Vector a) { return std::hypot(a[0], a[1], a[2]); }
/// Zero for the zero vector.
inline Vector unit(Vector a) {
    const double size = length(a);
    return size > 0 ? (1 / size) * a : Vector{};
}

}  // namespace importing
