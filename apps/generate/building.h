// Generated programs, built and run with the tools of this machine.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "generate/target.h"

namespace generate {

/// What became of a program: its exit code (128 + signal), and what it printed on both streams.
struct ToolResult {
    int exit_code = 0;
    std::string out, err;
};

/// Runs a program, found on PATH, without a shell. Throws candela::Error where it cannot be started.
ToolResult run_tool(const std::vector<std::string>& words);

/// Builds what was generated in `directory`, with CMake; a page needs no building. Throws candela::Error with
/// what the compiler says.
void build(const Target& target, const std::filesystem::path& directory);

/// Has the built program draw the scene as it is to a PNG file, without a display; a page is drawn by
/// headless Chromium. Throws candela::Error.
void draw(const Target& target, const std::filesystem::path& directory, const std::filesystem::path& picture);

/// Starts what was built, for a person to see. Returns its exit code.
int show(const Target& target, const std::filesystem::path& directory);

}  // namespace generate
