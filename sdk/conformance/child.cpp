#include "child.h"

#include <fmt/format.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <sstream>
#include <stdexcept>

#include "candela/file_descriptor.h"
#include "sandbox/guarded_child.h"

namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void judge(Outcome& outcome, const std::string& text, int status) {
    bool is_done = false;
    const auto worsen = [&](Verdict verdict) { outcome.verdict = std::max(outcome.verdict, verdict); };
    std::istringstream lines(text);
    lines.exceptions(std::ios::badbit);  // otherwise std::getline() swallows std::bad_alloc, and the rest is
                                         // lost
    for (std::string line; std::getline(lines, line);) {
        const std::size_t space = line.find(' ');
        const std::string verdict = line.substr(0, space);
        is_done = is_done || verdict == "done";
        if (verdict == "done") continue;
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
    const GuardedEnd end = run_guarded(seconds, [&](int report) {
        Findings findings(report);
        work(findings);
        findings.add("done", "");
    });
    Outcome outcome{group, Verdict::passed, {}, end.seconds};
    judge(outcome, end.is_late ? end.report + "done\n" : end.report, end.status);
    if (end.is_late) {
        outcome.verdict = Verdict::timed_out;
        outcome.messages.push_back(fmt::format("not finished after {} s", seconds));
    }
    return outcome;
}

Outcome run_here(const std::string& group, const std::function<void(Findings&)>& work) {
    const candela::FileDescriptor report(::memfd_create("candela-conformance", MFD_CLOEXEC));
    if (!report.is_open()) throw std::runtime_error(std::strerror(errno));
    const auto begin = std::chrono::steady_clock::now();
    Findings findings(report.number());
    work(findings);
    findings.add("done", "");
    Outcome outcome{group, Verdict::passed, {}, seconds_since(begin)};
    std::string text;
    ::lseek(report.number(), 0, SEEK_SET);
    char buffer[4096];
    for (ssize_t count = 0; (count = ::read(report.number(), buffer, sizeof buffer)) > 0;)
        text.append(buffer, static_cast<std::size_t>(count));
    judge(outcome, text, 0);
    return outcome;
}
