// Programs of this machine, run without a shell.
module;

#include "candela/api.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

export module candela.process;

export namespace candela {

/// What became of a program: its exit code (128 + signal where a signal ended it), and what it printed.
struct ProgramOutput {
    int exit_code = 0;
    std::string out, err;
};

/// Where PATH has an executable of that name.
CANDELA_API std::optional<std::filesystem::path> program_called(const std::string& name);

/// Runs a program, found on PATH where its name has no '/', without input, and waits for it. Throws Error
/// (failure) where it cannot be started. Any thread.
CANDELA_API ProgramOutput run_program(const std::vector<std::string>& words);

/// The same with this process's own streams. Returns the exit code.
CANDELA_API int show_program(const std::vector<std::string>& words);

}  // namespace candela
