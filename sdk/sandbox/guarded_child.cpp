#include "sandbox/guarded_child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstddef>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <stdexcept>

#include "candela/file_descriptor.h"
#include "sandbox/process_tree.h"
#include "sandbox/temporary_folder.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// The guardian's report on the child.
struct Verdict {
    int status;
    bool leaves_processes;
};

struct Pipe {
    candela::FileDescriptor source, sink;

    Pipe() {
        std::array<int, 2> ends{};
        if (::pipe2(ends.data(), O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
        source = candela::FileDescriptor(ends[0]);
        sink = candela::FileDescriptor(ends[1]);
    }
};

[[noreturn]] void be_the_child(int report, const std::function<void(int)>& work) {
    ::setpgid(0, 0);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = ::open("/dev/null", O_RDWR | O_CLOEXEC);
    if (nowhere < 0) ::_exit(1);  // the parent notices that the work was not done
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    work(report);
    // No plugin code runs after this.
    ::_exit(0);
}

/// A folder for the temporary files of a plugin and its child processes. If none can be created, whatever
/// needs one reports it.
void give_temporary_files(std::optional<TemporaryFolder>& folder) {
    try {
        folder.emplace("candela-check-");
        ::setenv("TMPDIR", folder->path().c_str(), 1);
    } catch (const std::runtime_error&) {
        folder.reset();
    }
}

/// The process in between. The programs that the child starts are its descendants; it ends them all and
/// removes their temporary files when the child has ended, when it is told to (SIGTERM), and when this
/// program is gone.
[[noreturn]] void be_the_guardian(pid_t parent, Pipe& report, Pipe& verdict,
                                  const std::function<void(int)>& work) {
    sigset_t awaited, usual;
    ::sigemptyset(&awaited);
    for (const int signal : {SIGCHLD, SIGTERM}) ::sigaddset(&awaited, signal);
    ::sigprocmask(SIG_BLOCK, &awaited, &usual);
    // Out of reach of the terminal's signals: the parent decides.
    ::setpgid(0, 0);
    inherit_orphans();
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != parent) ::_exit(1);
    report.source.close();
    verdict.source.close();
    const pid_t guardian = ::getpid();
    std::optional<TemporaryFolder> temporary;
    give_temporary_files(temporary);
    const pid_t child = ::fork();
    if (child < 0) ::_exit(1);
    if (child == 0) {
        // This program's signal handlers are not meant for a plugin.
        for (const int signal : {SIGINT, SIGTERM, SIGHUP}) ::signal(signal, SIG_DFL);
        ::sigprocmask(SIG_SETMASK, &usual, nullptr);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != guardian) ::_exit(1);
        verdict.sink.close();
        be_the_child(report.sink.number(), work);
    }
    for (;;) {
        int signal = 0;
        ::sigwait(&awaited, &signal);
        Verdict found{};
        bool has_ended = false;
        pid_t ended = 0;
        while (!has_ended && (ended = ::waitpid(-1, &found.status, WNOHANG)) > 0) has_ended = ended == child;
        if (!has_ended && signal != SIGTERM) continue;
        int ignored = 0;
        while ((ended = ::waitpid(-1, &ignored, WNOHANG)) > 0) {
        }
        found.leaves_processes = ended == 0;
        end_descendants();
        temporary.reset();
        if (has_ended && ::write(verdict.sink.number(), &found, sizeof found) != sizeof found) ::_exit(1);
        ::_exit(0);
    }
}

/// Reads the child's report until it ends or its time is over; returns whether it ended.
bool read_all(int report, double seconds, std::string& text) {
    const auto begin = Clock::now();
    for (;;) {
        const double left = seconds - seconds_since(begin);
        if (left <= 0) return false;
        pollfd wait{.fd = report, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&wait, 1, static_cast<int>(1000 * left) + 1);
        if (ready < 0 && errno != EINTR) throw std::runtime_error(std::strerror(errno));
        if (ready <= 0) continue;
        std::array<char, 4096> buffer{};
        const ssize_t count = ::read(report, buffer.data(), buffer.size());
        if (count == 0) return true;
        if (count > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    }
}

}  // namespace

GuardedEnd run_guarded(double seconds, const std::function<void(int)>& work) {
    Pipe report, verdict;
    const auto begin = Clock::now();
    // Boost.Process starts programs, but this child continues this one, which has no plugin in it yet.
    const pid_t parent = ::getpid();
    const pid_t guardian = ::fork();
    if (guardian < 0) throw std::runtime_error(std::strerror(errno));
    if (guardian == 0) be_the_guardian(parent, report, verdict, work);
    report.sink.close();
    verdict.sink.close();
    GuardedEnd result;
    // The guardian also holds the other end, which is closed once the child and everything it started have
    // ended.
    result.is_late = !read_all(report.source.number(), seconds, result.report);
    if (result.is_late) ::kill(guardian, SIGTERM);
    while (::waitpid(guardian, nullptr, 0) < 0 && errno == EINTR) {
    }
    Verdict found{.status = 1 << 8, .leaves_processes = false};  // exit code 1 if the guardian has failed
    if (!result.is_late && ::read(verdict.source.number(), &found, sizeof found) != sizeof found)
        found = {.status = 1 << 8, .leaves_processes = false};
    result.status = found.status;
    result.leaves_processes = found.leaves_processes;
    result.seconds = seconds_since(begin);
    return result;
}

std::string unexpected_end_of(const GuardedEnd& end, double seconds) {
    if (end.is_late) return fmt::format("did not finish within {} s", seconds);
    if (WIFSIGNALED(end.status))
        return fmt::format("ended the process with signal {}", ::strsignal(WTERMSIG(end.status)));
    return fmt::format("ended the process with exit code {}", WEXITSTATUS(end.status));
}
