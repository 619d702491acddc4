// Vectors, matrices and GLSL's functions in C++17, as far as a program's kernels have use for them.
#pragma once

#include <string>

namespace candela::cpp_target {

/// The library of vectors, in paragraphs of which a program takes those that it needs: without overloads, a
/// line each, for types that `kernels` do not speak of, and with the swizzles that they read.
std::string vectors_for(const std::string& kernels);

}  // namespace candela::cpp_target
