// Why loops over points were not vectorised, with the lines of the kernel that are the cause.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// What keeps a loop from being vectorised.
struct ScalarLoop {
    std::string place;  // "/home/me/cel.kernel:12:5"
    std::string why;    // as the compiler says it
};

/// Places and causes, each once, of the batch loops (candela/multiversion.h) of an object file that are
/// scalar; empty where there are none. `record`: what clang has noted of the file's loops
/// (-fsave-optimization-record, pass loop-vectorize). Places in `kernel` are told, and others only where
/// there are none.
std::vector<ScalarLoop> scalar_loops(const std::filesystem::path& record,
                                     const std::filesystem::path& kernel);
