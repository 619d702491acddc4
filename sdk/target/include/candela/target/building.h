// Builds and runs generated programs.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "candela/target.h"

namespace candela::target {

/// Runs a program. If its exit code is not 0, throws std::runtime_error with `problem` and the end of its
/// output.
void run(ProgramRunner& programs, const std::vector<std::string>& words, const std::string& problem);

/// Shows a program to the user; returns its exit code.
int show(ProgramRunner& programs, const std::vector<std::string>& words);

/// Builds the CMake project in `directory` in its folder build, with the compiler that CMake or the variable
/// CXX chooses, or else the newest one installed under a versioned name. `name`: of the target, for messages.
/// Throws std::runtime_error if there is no compiler or the program does not compile.
void build_with_cmake(ProgramRunner& programs, const std::string& directory, std::string_view name);

/// The end of a log, which contains the error.
std::string tail(const std::string& log);

}  // namespace candela::target
