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
    int exit_code = -1;  // 128 + signal if a signal ended it
    std::string out;
    std::string err;
};

struct CommandSetup {
    std::string input{};                                             // on stdin, which is not a terminal
    std::vector<std::pair<std::string, std::string>> environment{};  // added to this process's
    std::filesystem::path directory{};  // working directory; the scratch directory if empty
    std::function<void()> prepare{};    // called in the child before exec; may only make system calls
};

using Words = std::vector<std::string>;

/// The words of a command followed by more of them.
inline Words joined(Words words, const Words& more) {
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

/// Runs `candela arguments…` of the build tree.
CommandResult run_candela(const std::vector<std::string>& arguments, const CommandSetup& setup = {});
/// Runs any program, found on PATH like in a shell.
CommandResult run_program(const std::vector<std::string>& words, const CommandSetup& setup = {});

/// A program that runs while the test continues.
class RunningProgram {
  public:
    explicit RunningProgram(const std::vector<std::string>& words, const CommandSetup& setup = {});
    RunningProgram(const RunningProgram&) = delete;
    RunningProgram& operator=(const RunningProgram&) = delete;
    /// Kills it, unless wait() was called.
    ~RunningProgram();

    pid_t pid() const { return child_; }
    /// Whether it has ended; wait() then returns at once.
    bool has_ended() const;
    void send(int signal) const;
    /// Waits for its end. Call it once.
    CommandResult wait();

  private:
    pid_t child_ = -1;
    std::string in_, out_, err_;  // files
};

/// Which of a program's streams are the terminal; the others are files, as with run_candela().
struct OnTerminal {
    bool in = true;
    bool out = true;
    bool err = true;
};

/// A text to wait for on the terminal, and the reply to type.
struct Exchange {
    std::string wait_for;
    std::string typed;  // "\x03" is Ctrl-C, "\x04" Ctrl-D
};

/// Runs `candela arguments…` on its own terminal. `out` is what the terminal showed, plus what else was
/// written to stdout; `err` is stderr if that is not the terminal. Throws if what it waits for does not
/// appear.
CommandResult talk_to_candela(const std::vector<std::string>& arguments, const std::vector<Exchange>& talk,
                              const CommandSetup& setup = {}, OnTerminal streams = {});

/// Like talk_to_candela(), with everything typed at once.
CommandResult run_candela_on_terminal(const std::vector<std::string>& arguments, const std::string& typed,
                                      const CommandSetup& setup = {});

/// For a child: executes the program.
[[noreturn]] void become(const std::vector<std::string>& words, const CommandSetup& setup);
/// Waits for a child. Returns its exit code, or 128 + signal if a signal ended it.
int exit_code_of(pid_t child);

/// A new, empty directory for the running test; it stays for inspection until the same test runs again.
std::filesystem::path scratch_directory();

/// Writes a file, and returns its path.
std::filesystem::path write_file(const std::filesystem::path& path, const std::string& content);
std::string read_file(const std::filesystem::path& path);
