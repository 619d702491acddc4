// Vectors, matrices and GLSL's functions in C++17, as far as a program's kernels use them.
#pragma once

#include <string>

namespace candela::cpp_target {

/// The parts of the vector library that a program needs: without overloads, one line each, for types that
/// `kernels` do not use, and with the swizzles that they read.
std::string vectors_for(const std::string& kernels);

}  // namespace candela::cpp_target
