// The C++ compiler of this machine, for kernels that are compiled on the spot.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

import candela.process;

/// The one that the environment variable CXX names, or one that is usual; nothing if there is none.
std::optional<std::filesystem::path> kernel_compiler();

/// The folder of the headers that kernels are compiled with, beside the core's library. They may not be
/// installed.
std::filesystem::path kernel_headers();

/// Runs the compiler. What it leaves if it is killed is in `temporary`, whose owner removes it.
candela::ProgramOutput run_kernel_compiler(const std::filesystem::path& compiler,
                                           const std::vector<std::string>& arguments,
                                           const std::filesystem::path& temporary);

/// The first line of a compiler's messages that says what is wrong.
std::string first_error(const std::string& messages);
