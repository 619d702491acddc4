// Runs programs of this machine, without a shell.
#pragma once

#include <chrono>
#include <filesystem>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace candela {

/// How a program ended: by itself, or by run_program(), because its time was up or it was no longer wanted.
enum class ProgramEnd { own, late, unwanted };

/// A program's exit code (128 + signal if a signal ended it), and what it printed.
struct ProgramOutput {
    int exit_code = 0;
    std::string out, err;
    ProgramEnd end = ProgramEnd::own;
};

/// How long a program may take, and who may end it earlier. It is ended by SIGTERM and, if still running two
/// seconds later, by SIGKILL.
struct Patience {
    std::optional<std::chrono::milliseconds> longest{};
    std::stop_token unwanted{};
};

/// The path of an executable of that name on PATH.
std::optional<std::filesystem::path> program_called(const std::string& name);

/// The C++ compiler of this machine: the one that the environment variable CXX names, otherwise (also if CXX
/// is a command of several words) the newest clang++, otherwise the newest g++. Nothing if there is none.
/// Throws Error (failure) if CXX names a program that is not installed.
std::optional<std::filesystem::path> cxx_compiler();

/// Runs a program without input and waits for it. A name without '/' is looked up on PATH. Throws Error
/// (failure) if the program cannot be started. Any thread.
ProgramOutput run_program(const std::vector<std::string>& words, const Patience& patience = {});

/// Like run_program(), but inherits this process's streams. Returns the exit code.
int show_program(const std::vector<std::string>& words);

/// A program that answers each line of input with a line, and ends at the end of its input. One thread at a
/// time.
class AnsweringProgram {
  public:
    /// Starts the program; throws like run_program().
    explicit AnsweringProgram(const std::vector<std::string>& words);
    AnsweringProgram(const AnsweringProgram&) = delete;
    AnsweringProgram& operator=(const AnsweringProgram&) = delete;
    /// Ends the program and waits for it.
    ~AnsweringProgram();

    /// Returns the program's answer to `line`, both without a line break. Nothing if the program ends or does
    /// not answer in time; it is then unusable.
    std::optional<std::string> answer(std::string line, std::chrono::milliseconds patience);
    /// Everything that it has printed on its standard error so far.
    std::string errors() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// A program that prepares itself, then waits for a line on its standard input before doing its work. One
/// thread at a time.
class WaitingProgram {
  public:
    /// Starts the program; throws like run_program().
    explicit WaitingProgram(const std::vector<std::string>& words);
    WaitingProgram(const WaitingProgram&) = delete;
    WaitingProgram& operator=(const WaitingProgram&) = delete;
    /// Ends the program and waits for it.
    ~WaitingProgram();

    /// Tells the program to continue, and waits for its end. Nothing if it had already ended. Call it once.
    std::optional<ProgramOutput> go_on(const Patience& patience = {});

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace candela
