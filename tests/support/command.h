// The built command as a child process, and files for it.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <functional>
#include <initializer_list>
#include <string>
#include <utility>
#include <vector>

struct CommandResult {
    int exit_code = -1;  // 128 + signal where a signal ended it
    std::string out;
    std::string err;
};

struct CommandSetup {
    std::string input;                                             // on stdin, which is no terminal
    std::vector<std::pair<std::string, std::string>> environment;  // added to this process's
    std::filesystem::path directory;  // to run in; the scratch directory if empty
    std::function<void()>
        prepare{};  // called in the child before it becomes the program; may only make system calls
};

/// Runs `candela arguments…` of the build tree.
CommandResult run_candela(const std::vector<std::string>& arguments, const CommandSetup& setup = {});
/// Runs any program, found as a shell finds it.
CommandResult run_program(const std::vector<std::string>& words, const CommandSetup& setup = {});

/// A program that runs beside the test.
class RunningProgram {
  public:
    explicit RunningProgram(const std::vector<std::string>& words, const CommandSetup& setup = {});
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    /// Kills it, if nobody has waited for its end.
    ~RunningProgram();

    pid_t pid() const { return child_; }
    /// Whether it has ended; wait() then returns at once.
    bool has_ended() const;
    void send(int signal) const;
    /// Waits for its end; to be called once.
    CommandResult wait();

  private:
    pid_t child_ = -1;
    std::string in_, out_, err_;  // files
};

/// Runs `candela arguments…` on a terminal of its own, types `typed`, and returns what the terminal showed
/// (as `out`).
CommandResult run_candela_on_terminal(const std::vector<std::string>& arguments, const std::string& typed,
                                      const CommandSetup& setup = {});

/// A new, empty directory of the running test; it stays for inspection until the same test runs again.
std::filesystem::path scratch_directory();

/// Writes a file, and returns its path.
std::filesystem::path write_file(const std::filesystem::path& path, const std::string& content);
std::string read_file(const std::filesystem::path& path);
