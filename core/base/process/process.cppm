// Programs of this machine, run without a shell.
module;

#include "candela/api.h"

#include <chrono>
#include <condition_variable>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <vector>

export module candela.process;

namespace candela {

/// To be locked while pipes are made and a program is started: one that another thread starts at that moment
/// would keep them open, and who reads from them would wait for its end.
std::mutex& starting();

/// To be called in the new process, before it is another program: it would keep the signals that the thread
/// that starts it has blocked, and the files and sockets that are open here. It has its three standard
/// streams, and nothing else. Async-signal-safe.
void shed_inheritance() noexcept;

}  // namespace candela

export namespace candela {

/// Who has ended a program: itself, or run_program() because its time was over or nobody wanted it any more.
enum class ProgramEnd { own, late, unwanted };

/// What became of a program: its exit code (128 + signal where a signal ended it), and what it printed.
struct ProgramOutput {
    int exit_code = 0;
    std::string out, err;
    ProgramEnd end = ProgramEnd::own;
};

/// How long a program may take, and who may end it earlier. It is ended by SIGTERM and, if it is still there
/// after two seconds, by SIGKILL.
struct Patience {
    std::optional<std::chrono::milliseconds> longest{};
    std::stop_token unwanted{};
};

/// Where PATH has an executable of that name.
CANDELA_API std::optional<std::filesystem::path> program_called(const std::string& name);

/// The C++ compiler of this machine: the one that the environment variable CXX names, else the newest
/// clang++, else the newest g++. Nothing if there is none.
CANDELA_API std::optional<std::filesystem::path> cxx_compiler();

/// Runs a program, found on PATH where its name has no '/', without input, and waits for it. Throws Error
/// (failure) where it cannot be started. Any thread.
CANDELA_API ProgramOutput run_program(const std::vector<std::string>& words, const Patience& patience = {});

/// The same with this process's own streams. Returns the exit code.
CANDELA_API int show_program(const std::vector<std::string>& words);

/// A program that answers each line that it is told with a line, and ends when nothing more comes. One thread
/// at a time.
class CANDELA_API AnsweringProgram {
  public:
    /// Starts it; throws like run_program().
    explicit AnsweringProgram(const std::vector<std::string>& words);
    AnsweringProgram(const AnsweringProgram&) = delete;
    AnsweringProgram& operator=(const AnsweringProgram&) = delete;
    /// Ends it, and waits for its end.
    ~AnsweringProgram();

    /// What it answers to `line`, both without a line break. Nothing if it ends instead, or does not answer
    /// for so long; it is of no more use then.
    std::optional<std::string> answer(std::string line, std::chrono::milliseconds patience);
    /// What it has printed as errors so far.
    std::string errors() const;

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

/// A program that gets ready, and waits for a line on its standard input before it does what it is for. One
/// thread at a time.
class CANDELA_API WaitingProgram {
  public:
    /// Starts it; throws like run_program().
    explicit WaitingProgram(const std::vector<std::string>& words);
    WaitingProgram(const WaitingProgram&) = delete;
    WaitingProgram& operator=(const WaitingProgram&) = delete;
    /// Ends it, and waits for its end.
    ~WaitingProgram();

    /// Tells it to go on, and waits for its end. Nothing if it has ended before. Call it once.
    std::optional<ProgramOutput> go_on(const Patience& patience = {});

  private:
    class Implementation;
    std::unique_ptr<Implementation> implementation_;
};

}  // namespace candela

namespace candela {

/// Ends a program when the patience with it is over.
class Overseer {
  public:
    /// `process`: its number. Nobody else may wait for it until await() has.
    Overseer(int process, const Patience& patience);
    Overseer(const Overseer&) = delete;
    Overseer& operator=(const Overseer&) = delete;
    ~Overseer();

    /// Waits for the program's end, which is still to be had from the system afterwards. Who has ended it.
    ProgramEnd await();

  private:
    void dismiss();
    void oversee(const Patience& patience);

    int process_;
    std::mutex mutex_;
    std::condition_variable_any news_;
    bool has_ended_ = false;
    ProgramEnd end_ = ProgramEnd::own;
    std::thread thread_;
};

}  // namespace candela
