#include "child.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <optional>
#include <sstream>
#include <stdexcept>

#include "descendants.h"
#include "temporary_folder.h"

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

[[noreturn]] void be_the_child(int report, const std::function<void(Findings&)>& work) {
    ::setpgid(0, 0);
    const rlimit no_core{0, 0};
    ::setrlimit(RLIMIT_CORE, &no_core);
    const int nowhere = ::open("/dev/null", O_RDWR);
    if (nowhere < 0) ::_exit(1);  // the parent finds that the child did not end
    for (const int standard : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) ::dup2(nowhere, standard);
    Findings findings(report);
    work(findings);
    findings.add("done", "");
    // Nothing of the plugin's runs after this.
    ::_exit(0);
}

/// A folder for the temporary files of a plugin, and of what it starts. Where there can be none, whoever
/// needs one says so.
void give_temporary_files(std::optional<TemporaryFolder>& folder) {
    try {
        folder.emplace(std::filesystem::temp_directory_path(), "candela-check-");
        ::setenv("TMPDIR", folder->path().c_str(), 1);
    } catch (const std::runtime_error&) {
        folder.reset();
    }
}

/// The process between the kit and the plugin: it has what the plugin starts as its descendants, and ends all
/// of them, and removes their temporary files, when the plugin has ended, when the kit asks for it (SIGTERM),
/// and when the kit is gone.
[[noreturn]] void be_the_guardian(pid_t kit, int report, const std::function<void(Findings&)>& work) {
    sigset_t awaited, usual;
    ::sigemptyset(&awaited);
    for (const int signal : {SIGCHLD, SIGTERM}) ::sigaddset(&awaited, signal);
    ::sigprocmask(SIG_BLOCK, &awaited, &usual);
    // Not with the terminal's signals: the kit decides.
    ::setpgid(0, 0);
    inherit_orphans();
    ::prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (::getppid() != kit) ::_exit(1);
    const pid_t guardian = ::getpid();
    std::optional<TemporaryFolder> temporary;
    give_temporary_files(temporary);
    const pid_t worker = ::fork();
    if (worker < 0) ::_exit(1);
    if (worker == 0) {
        ::sigprocmask(SIG_SETMASK, &usual, nullptr);
        ::prctl(PR_SET_PDEATHSIG, SIGKILL);
        if (::getppid() != guardian) ::_exit(1);
        be_the_child(report, work);
    }
    for (;;) {
        int signal = 0;
        ::sigwait(&awaited, &signal);
        int status = 0;
        bool has_ended = false;
        while (const pid_t ended = ::waitpid(-1, &status, WNOHANG)) {
            has_ended = ended == worker;
            if (ended < 0 || has_ended) break;
        }
        if (!has_ended && signal != SIGTERM) continue;
        end_descendants();
        temporary.reset();
        if (has_ended) Findings(report).add("ended", std::to_string(status));
        ::_exit(0);
    }
}

/// All that the child says until it ends or its time is over; whether it ended.
bool read_all(int report, double seconds, std::string& text) {
    const auto begin = Clock::now();
    for (;;) {
        const double left = seconds - seconds_since(begin);
        if (left <= 0) return false;
        pollfd wait{.fd = report, .events = POLLIN, .revents = 0};
        const int ready = ::poll(&wait, 1, static_cast<int>(1000 * left) + 1);
        if (ready < 0 && errno != EINTR) throw std::runtime_error(std::strerror(errno));
        if (ready <= 0) continue;
        char buffer[4096];
        const ssize_t count = ::read(report, buffer, sizeof buffer);
        if (count == 0) return true;
        if (count > 0) text.append(buffer, static_cast<std::size_t>(count));
    }
}

void judge(Outcome& outcome, const std::string& text) {
    bool is_done = false;
    int status = 0;
    const auto worsen = [&](Verdict verdict) { outcome.verdict = std::max(outcome.verdict, verdict); };
    std::istringstream lines(text);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = line.find(' ');
        const std::string verdict = line.substr(0, space);
        is_done = is_done || verdict == "done";
        if (verdict == "ended") status = std::stoi(line.substr(space + 1));
        if (verdict == "done" || verdict == "ended") continue;
        outcome.messages.push_back(space == std::string::npos ? "" : line.substr(space + 1));
        worsen(verdict == "failed"    ? Verdict::failed
               : verdict == "skipped" ? Verdict::skipped
                                      : Verdict::warning);
    }
    if (WIFSIGNALED(status)) {
        worsen(Verdict::crashed);
        const char* const name = ::sigabbrev_np(WTERMSIG(status));
        outcome.messages.push_back(fmt::format("ended by signal SIG{}", name != nullptr ? name : "?"));
    } else if (!is_done) {
        worsen(Verdict::crashed);
        outcome.messages.push_back(
            fmt::format("the plugin ended the process, with exit code {}", WEXITSTATUS(status)));
    }
}

}  // namespace

const char* name_of(Verdict verdict) {
    switch (verdict) {
        case Verdict::passed:
            return "passed";
        case Verdict::warning:
            return "warning";
        case Verdict::skipped:
            return "skipped";
        case Verdict::failed:
            return "failed";
        case Verdict::crashed:
            return "crashed";
        case Verdict::timed_out:
            return "timed out";
    }
    return "?";
}

void Findings::add(const char* verdict, const std::string& message) {
    std::string line = fmt::format("{} {}", verdict, message);
    std::ranges::replace(line, '\n', ' ');
    line += '\n';
    if (::write(descriptor_, line.data(), line.size()) < 0) ::_exit(126);
}

Outcome run_in_child(const std::string& group, double seconds, const std::function<void(Findings&)>& work) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) throw std::runtime_error(std::strerror(errno));
    const auto begin = Clock::now();
    // Boost.Process starts programs; this child goes on in this one, which has nothing of a plugin in it yet.
    const pid_t kit = ::getpid();
    const pid_t guardian = ::fork();
    if (guardian < 0) throw std::runtime_error(std::strerror(errno));
    if (guardian == 0) {
        ::close(ends[0]);
        be_the_guardian(kit, ends[1], work);
    }
    ::close(ends[1]);
    Outcome outcome{group, Verdict::passed, {}, 0};
    std::string text;
    const bool ended = read_all(ends[0], seconds, text);
    if (!ended) ::kill(guardian, SIGTERM);
    ::close(ends[0]);
    while (::waitpid(guardian, nullptr, 0) < 0 && errno == EINTR) {
    }
    outcome.seconds = seconds_since(begin);
    judge(outcome, ended ? text : text + "done\n");
    if (!ended) {
        outcome.verdict = Verdict::timed_out;
        outcome.messages.push_back(fmt::format("not finished after {} s", seconds));
    }
    return outcome;
}

Outcome run_here(const std::string& group, const std::function<void(Findings&)>& work) {
    const int report = ::memfd_create("candela-conformance", MFD_CLOEXEC);
    if (report < 0) throw std::runtime_error(std::strerror(errno));
    const auto begin = Clock::now();
    Findings findings(report);
    work(findings);
    findings.add("done", "");
    Outcome outcome{group, Verdict::passed, {}, seconds_since(begin)};
    std::string text;
    ::lseek(report, 0, SEEK_SET);
    char buffer[4096];
    for (ssize_t count = 0; (count = ::read(report, buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(count));
    ::close(report);
    judge(outcome, text);
    return outcome;
}
