// Programs of this machine that the kit runs: compilers.
#pragma once

#include <optional>
#include <string>
#include <vector>

/// What became of a program: its exit code (126 where a signal ended it), and what it printed, to either
/// stream.
struct ProgramOutput {
    int exit_code = 0;
    std::string text;
};

/// The path of the first of the names that is a program on PATH.
std::optional<std::string> program_called(const std::vector<std::string>& names);

/// Runs a program without input, and waits for it. Throws std::system_error where it cannot be started.
ProgramOutput output_of(const std::string& program, const std::vector<std::string>& arguments);
