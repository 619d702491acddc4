// Compiles kernels at run time with cxx_compiler().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.util;

/// The folder of the headers for compiling kernels, next to the core's library. They may not be installed.
std::filesystem::path kernel_headers();

/// Runs the compiler. If it is killed, its leftovers are in `temporary`, whose owner removes it.
candela::ProgramOutput run_kernel_compiler(const std::filesystem::path& compiler,
                                           const std::vector<std::string>& arguments,
                                           const std::filesystem::path& temporary);

/// The first error in a compiler's messages.
std::string first_error(const std::string& messages);
