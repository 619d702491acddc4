// Compiles programs and libraries that contain kernels, at run time, with a compiler of this machine
// (cxx_compiler()).
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace candela::kernel_language {

/// The folder that contains candela/kernel/kernel.h, above that of the installed plugins; empty if the
/// headers are not installed.
std::filesystem::path kernel_headers();

/// The C++20 to compile, and how.
struct Compilation {
    std::vector<std::string> options{};
    std::vector<std::filesystem::path> inputs{};  // source files, then libraries
    std::filesystem::path output{};
    /// The compiler's folder for temporary files: if it is killed, it leaves them behind, and the folder's
    /// owner removes them.
    std::filesystem::path temporary{};
};

struct CompilerReport {
    bool is_success = false;
    std::string log{};  // its messages
};

CompilerReport compile(const std::filesystem::path& compiler, const Compilation& compilation);

/// The first `most` lines of a log that are wanted.
std::vector<std::string> lines_of(const std::string& log, std::size_t most,
                                  const std::function<bool(const std::string&)>& is_wanted);

/// The first error in a compiler's log; the beginning of a log that has none.
std::string first_error(const std::string& log);

}  // namespace candela::kernel_language
