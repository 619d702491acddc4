// Kernels that are compiled on the spot, by cxx_compiler().
#pragma once

#include <filesystem>
#include <string>
#include <vector>

import candela.process;

/// The folder of the headers that kernels are compiled with, beside the core's library. They may not be
/// installed.
std::filesystem::path kernel_headers();

/// Runs the compiler. What it leaves if it is killed is in `temporary`, whose owner removes it.
candela::ProgramOutput run_kernel_compiler(const std::filesystem::path& compiler,
                                           const std::vector<std::string>& arguments,
                                           const std::filesystem::path& temporary);

/// The first line of a compiler's messages that says what is wrong.
std::string first_error(const std::string& messages);
