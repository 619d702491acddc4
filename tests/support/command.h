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

/// Which of a program's streams are the terminal; the others are a file, as with run_candela().
struct OnTerminal {
    bool in = true;
    bool out = true;
    bool err = true;
};

/// What a person waits for on the terminal, and types then.
struct Exchange {
    std::string wait_for;
    std::string typed;  // "\x03" is Ctrl-C, "\x04" Ctrl-D
};

/// Runs `candela arguments…` on a terminal of its own, and returns what the terminal showed as `out`, with
/// what else stdout got; `err` is stderr where that is no terminal. Throws where what is waited for does not
/// come.
CommandResult talk_to_candela(const std::vector<std::string>& arguments, const std::vector<Exchange>& talk,
                              const CommandSetup& setup = {}, OnTerminal streams = {});

/// Likewise, all typed at once.
CommandResult run_candela_on_terminal(const std::vector<std::string>& arguments, const std::string& typed,
                                      const CommandSetup& setup = {});

/// For a child: becomes the program.
[[noreturn]] void become(const std::vector<std::string>& words, const CommandSetup& setup);
/// Waits for a child; 128 + signal where a signal ended it.
int exit_code_of(pid_t child);

/// A new, empty directory of the running test; it stays for inspection until the same test runs again.
std::filesystem::path scratch_directory();

/// Writes a file, and returns its path.
std::filesystem::path write_file(const std::filesystem::path& path, const std::string& content);
std::string read_file(const std::filesystem::path& path);
