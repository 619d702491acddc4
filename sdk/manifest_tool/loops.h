// Why loops over points were not vectorised, with the responsible lines of the kernel.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// The reason why a loop was not vectorised.
struct ScalarLoop {
    std::string place;  // "/home/me/cel.kernel:12:5"
    std::string why;    // in the compiler's words
};

/// The scalar batch loops (candela/kernel/simd_dispatch.h) of an object file, as places and causes, each
/// once; empty if there are none. `record`: clang's remarks on the file's loops (-fsave-optimization-record,
/// pass loop-vectorize). Places in `kernel` are preferred; others are returned only if there are none.
std::vector<ScalarLoop> scalar_loops(const std::filesystem::path& record,
                                     const std::filesystem::path& kernel);
