#include "process/process.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/close_range.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#define BOOST_PROCESS_USE_STD_FS
#include <algorithm>
#include <array>
#include <boost/process/args.hpp>
#include <boost/process/child.hpp>
#include <boost/process/extend.hpp>
#include <boost/process/io.hpp>
#include <boost/process/pipe.hpp>
#include <boost/process/posix.hpp>
#include <boost/process/search_path.hpp>
#include <cerrno>
#include <chrono>
#include <condition_variable>
#include <csignal>
#include <cstddef>
#include <cstring>
#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "candela/file_descriptor.h"

import candela.util;

namespace candela {

namespace {

namespace process = boost::process;
using std::chrono::milliseconds;
using std::chrono::steady_clock;

/// Lock it while making pipes and starting a program. A program that another thread starts at that moment
/// would keep the pipes open, and their reader would wait for its end.
std::mutex& starting() {
    static std::mutex mutex;
    return mutex;
}

/// Call it in the child process before exec. Otherwise the new program would inherit the signals that the
/// thread has blocked, and the open files and sockets. It keeps only the three standard streams.
/// Async-signal-safe.
void shed_inheritance() noexcept {
    sigset_t none;
    ::sigemptyset(&none);
    ::sigprocmask(SIG_SETMASK, &none, nullptr);
    constexpr unsigned k_first = STDERR_FILENO + 1;
    if (::close_range(k_first, ~0U, CLOSE_RANGE_CLOEXEC) == 0) return;
    // Linux before 5.11.
    constexpr rlim_t k_most = 65536;
    rlimit files{};
    if (::getrlimit(RLIMIT_NOFILE, &files) != 0) files.rlim_cur = k_most;
    const int end = static_cast<int>(std::min(files.rlim_cur, k_most));
    for (int file = k_first; file < end; ++file) ::fcntl(file, F_SETFD, FD_CLOEXEC);
}

/// Ends a program that runs out of patience.
class Overseer {
  public:
    /// `process`: its process ID. Nobody else may wait for the process until await() has returned.
    Overseer(int process, const Patience& patience);
    Overseer(const Overseer&) = delete;
    Overseer& operator=(const Overseer&) = delete;
    ~Overseer();

    /// Waits for the program's end, and returns how it ended. The exit status can still be collected from the
    /// system.
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

Overseer::Overseer(int process, const Patience& patience) : process_(process) {
    if (patience.longest || patience.unwanted.stop_possible())
        thread_ = std::thread([this, patience] { oversee(patience); });
}

Overseer::~Overseer() { dismiss(); }

ProgramEnd Overseer::await() {
    // Leaves the process to be waited for: until then, its ID is not reused.
    siginfo_t state{};
    while (::waitid(P_PID, static_cast<id_t>(process_), &state, WEXITED | WNOWAIT) < 0 && errno == EINTR) {
    }
    dismiss();
    return end_;
}

void Overseer::dismiss() {
    {
        const std::lock_guard lock(mutex_);
        has_ended_ = true;
    }
    news_.notify_all();
    if (thread_.joinable()) thread_.join();
}

void Overseer::oversee(const Patience& patience) {
    constexpr std::chrono::hours k_ever{24 * 365};
    constexpr std::chrono::seconds k_longest_end{2};
    std::unique_lock lock(mutex_);
    const auto has_ended = [this] { return has_ended_; };
    if (news_.wait_for(lock, patience.unwanted, patience.longest.value_or(k_ever), has_ended)) return;
    end_ = patience.unwanted.stop_requested() ? ProgramEnd::unwanted : ProgramEnd::late;
    ::kill(process_, SIGTERM);
    if (!news_.wait_for(lock, k_longest_end, has_ended)) ::kill(process_, SIGKILL);
}

template <class... Streams>
process::child started(const std::vector<std::string>& words, Streams&&... streams) {
    const std::string& name = words.front();
    std::filesystem::path program = name;
    if (name.find('/') == std::string::npos) {
        const auto found = program_called(name);
        if (!found) {
            throw Error(ErrorCategory::failure,
                        fmt::format("this needs the program '{}', which is not installed", name));
        }
        program = *found;
    }
    try {
        const std::vector<std::string> arguments(words.begin() + 1, words.end());
        return process::child(
            program, process::args(arguments),
            process::extend::on_exec_setup = [](auto&) { shed_inheritance(); },
            std::forward<Streams>(streams)...);
    } catch (const std::system_error& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' cannot be run: {}", name, problem.code().message()));
    }
}

int exit_code_of(process::child& child) {
    child.wait();
    const int status = child.native_exit_code();
    return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

/// Reads in large pieces: a stream would read a kilobyte at a time.
std::string all_of(process::ipstream& stream) {
    std::string text;
    std::vector<char> piece(std::size_t{1} << 16);
    for (;;) {
        const ssize_t count = ::read(stream.pipe().native_source(), piece.data(), piece.size());
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) return text;
        text.append(piece.data(), static_cast<std::size_t>(count));
    }
}

constexpr milliseconds k_longest_end{2000};

/// Throws Error, with the reason in errno, if the system did not give a descriptor.
FileDescriptor valid(int number) {
    if (number >= 0) return FileDescriptor(number);
    throw Error(ErrorCategory::failure,
                fmt::format("cannot create a connection to another program: {}", std::strerror(errno)));
}

/// Two connected ends, which other programs do not inherit. Writing to a socket does not raise SIGPIPE;
/// writing to a pipe may.
std::array<FileDescriptor, 2> connected() {
    std::array<int, 2> ends{-1, -1};
    static_cast<void>(::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends.data()));
    return {valid(ends[0]), valid(ends[1])};
}

/// The contents of a file in memory.
std::string content_of(const FileDescriptor& file) {
    struct stat status{};
    if (::fstat(file.number(), &status) != 0) return {};
    std::string text(static_cast<std::size_t>(status.st_size), '\0');
    std::size_t done = 0;
    while (done < text.size()) {
        const ssize_t count =
            ::pread(file.number(), text.data() + done, text.size() - done, static_cast<off_t>(done));
        if (count < 0 && errno == EINTR) continue;
        if (count <= 0) break;
        done += static_cast<std::size_t>(count);
    }
    text.resize(done);
    return text;
}

/// A program that runs in parallel with this one and receives input on its standard input.
class ChildProcess {
  public:
    /// `output`: the descriptor that it prints to; -1: the one that its input comes from.
    explicit ChildProcess(const std::vector<std::string>& words, int output = -1)
        // In memory, so that a program that prints a lot does not wait for a reader.
        : errors_(valid(::memfd_create("errors", MFD_CLOEXEC))) {
        std::array<FileDescriptor, 2> ends = connected();
        const std::lock_guard lock(starting());
        process::child child =
            started(words, process::posix::fd.bind(STDIN_FILENO, ends[1].number()),
                    process::posix::fd.bind(STDOUT_FILENO, output < 0 ? ends[1].number() : output),
                    process::posix::fd.bind(STDERR_FILENO, errors_.number()));
        process_ = child.id();
        child.detach();
        connection_ = std::move(ends[0]);
    }
    ChildProcess(const ChildProcess&) = delete;
    ChildProcess& operator=(const ChildProcess&) = delete;
    ~ChildProcess() {
        if (process_ < 0) return;
        ::kill(process_, SIGTERM);
        const auto end = steady_clock::now() + k_longest_end;
        while (is_running()) {
            if (steady_clock::now() > end) ::kill(process_, SIGKILL);
            std::this_thread::sleep_for(milliseconds(1));
        }
    }

    const FileDescriptor& connection() const { return connection_; }
    std::string errors() const { return content_of(errors_); }

    /// Returns false if the program has ended.
    bool send(std::string_view text) const {
        while (!text.empty()) {
            const ssize_t count = ::send(connection_.number(), text.data(), text.size(), MSG_NOSIGNAL);
            if (count < 0 && errno == EINTR) continue;
            if (count <= 0) return false;
            text.remove_prefix(static_cast<std::size_t>(count));
        }
        return true;
    }

    ProgramEnd await(const Patience& patience) const { return Overseer(process_, patience).await(); }

    /// Waits for its end. Returns its exit code, or 128 + signal if a signal ended it.
    int wait() {
        int status = 0;
        pid_t ended = -1;
        do {
            ended = ::waitpid(process_, &status, 0);
        } while (ended < 0 && errno == EINTR);
        process_ = -1;
        // Code that ends all programs may have waited for this one already.
        if (ended < 0) return 128 + SIGKILL;
        return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }

  private:
    /// May also have been waited for already.
    bool is_running() const { return ::waitpid(process_, nullptr, WNOHANG) == 0; }

    FileDescriptor errors_, connection_;
    pid_t process_ = -1;
};

}  // namespace

std::optional<std::filesystem::path> program_called(const std::string& name) {
    const auto path = process::search_path(name);
    return path.empty() ? std::nullopt : std::optional(path);
}

ProgramOutput run_program(const std::vector<std::string>& words, const Patience& patience) {
    std::unique_lock lock(starting());
    process::ipstream out, err;
    process::child child =
        started(words, process::std_in<process::null, process::std_out> out, process::std_err > err);
    lock.unlock();
    ProgramOutput output;
    Overseer overseer(child.id(), patience);
    // A program that has filled one pipe waits for its reader, so both are read at once.
    std::thread reader([&] { output.err = all_of(err); });
    output.out = all_of(out);
    reader.join();
    output.end = overseer.await();
    output.exit_code = exit_code_of(child);
    return output;
}

int show_program(const std::vector<std::string>& words) {
    process::child child = started(words);
    return exit_code_of(child);
}

class AnsweringProgram::Implementation {
  public:
    explicit Implementation(const std::vector<std::string>& words) : program_(words) {}

    std::optional<std::string> answer(std::string line, milliseconds patience) {
        const auto end = steady_clock::now() + patience;
        line += '\n';
        if (!program_.send(line)) return std::nullopt;
        for (;;) {
            if (const std::size_t at = received_.find('\n'); at != std::string::npos) {
                std::string found = received_.substr(0, at);
                received_.erase(0, at + 1);
                return found;
            }
            if (!receive(std::chrono::duration_cast<milliseconds>(end - steady_clock::now())))
                return std::nullopt;
        }
    }

    std::string errors() const { return program_.errors(); }

  private:
    /// Returns false at the end of the program, or when patience runs out.
    bool receive(milliseconds patience) {
        const int connection = program_.connection().number();
        pollfd source{.fd = connection, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&source, 1, static_cast<int>(std::max(patience, milliseconds(0)).count()));
        if (ready < 0 && errno == EINTR) return true;
        if (ready <= 0) return false;
        std::array<char, 65536> part{};
        const ssize_t count = ::recv(connection, part.data(), part.size(), 0);
        if (count <= 0) return count < 0 && errno == EINTR;
        received_.append(part.data(), static_cast<std::size_t>(count));
        return true;
    }

    ChildProcess program_;
    std::string received_;
};

AnsweringProgram::AnsweringProgram(const std::vector<std::string>& words)
    : implementation_(std::make_unique<Implementation>(words)) {}
AnsweringProgram::~AnsweringProgram() = default;

std::optional<std::string> AnsweringProgram::answer(std::string line, milliseconds patience) {
    return implementation_->answer(std::move(line), patience);
}

std::string AnsweringProgram::errors() const { return implementation_->errors(); }

class WaitingProgram::Implementation {
  public:
    explicit Implementation(const std::vector<std::string>& words)
        : output_(valid(::memfd_create("output", MFD_CLOEXEC))), program_(words, output_.number()) {}

    std::optional<ProgramOutput> go_on(const Patience& patience) {
        if (!program_.send("\n")) return std::nullopt;
        ProgramOutput result;
        result.end = program_.await(patience);
        result.exit_code = program_.wait();
        result.out = content_of(output_);
        result.err = program_.errors();
        return result;
    }

  private:
    FileDescriptor output_;
    ChildProcess program_;
};

WaitingProgram::WaitingProgram(const std::vector<std::string>& words)
    : implementation_(std::make_unique<Implementation>(words)) {}
WaitingProgram::~WaitingProgram() = default;

std::optional<ProgramOutput> WaitingProgram::go_on(const Patience& patience) {
    return implementation_->go_on(patience);
}

}  // namespace candela
