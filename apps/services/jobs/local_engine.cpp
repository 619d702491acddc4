// Runs the tasks of a job as processes on this machine.
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstring>
#include <exception>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "jobs/engines.h"
#include "jobs/heartbeat.h"
#include "jobs/state.h"
#include "process/process.h"
#include "sandbox/process_tree.h"

import candela.util;

namespace {

/// Why the task failed; nothing if it succeeded.
std::optional<std::string> failure_of(const Words& command) {
    try {
        const candela::ProgramOutput done = candela::run_program(command);
        constexpr int k_signal = 128;
        if (done.exit_code > k_signal) {
            const int signal = done.exit_code - k_signal;
            return fmt::format("it was killed by signal {} ({})", signal, ::strsignal(signal));
        }
        return done.exit_code == 0 ? std::nullopt : std::optional(done.err);
    } catch (const std::exception& problem) {
        return problem.what();
    }
}

/// Records why a task failed, unless it did so itself. Returns what to add to the report if that fails, too.
std::string record_failure(const std::filesystem::path& journal, const std::string& why) {
    try {
        const auto said = read_journal(journal);
        if (!said || said->state != JournalEntry::State::failed) write_failure(journal, why);
        return {};
    } catch (const std::exception& problem) {
        return fmt::format("\n(not recorded: {})", problem.what());
    }
}

/// Runs one task; reports and records why it failed, if it did.
bool run_task(const std::string& name, const Words& command, const JobFolder& folder) {
    const auto wait_for_the_end = [] {
        while (are_descendants_ending()) ::pause();
    };
    wait_for_the_end();  // before starting another
    const auto failure = failure_of(command);
    // A signal handler may have ended it and waited for it, and is about to end this process.
    wait_for_the_end();
    if (!failure) return true;
    std::string why = *failure;
    why.erase(why.find_last_not_of('\n') + 1);
    why += record_failure(folder.journal_of(name), why);
    static std::mutex mutex;
    const std::scoped_lock lock(mutex);
    fail(ExitCode::failure, fmt::format("task {}: {}", name, why));
    return false;
}

}  // namespace

int run_locally(const Submission& job, std::size_t processes) {
    end_descendants_on_signals();
    std::atomic<std::size_t> next{0}, done{0}, failed{0};
    {
        ProgressBar bar("rendering", !is_quiet());
        std::vector<std::thread> workers;
        const auto work = [&] {
            for (std::size_t i = next++; i < job.open.size(); i = next++) {
                const std::size_t task = job.open[i];
                if (!run_task(job.plan.tasks[task].name, job.commands[task], job.folder)) ++failed;
                bar.update(++done, job.open.size());
            }
        };
        for (std::size_t i = 0; i < std::min(processes, job.open.size()); ++i) workers.emplace_back(work);
        for (std::thread& worker : workers) worker.join();
    }
    if (failed > 0) {
        return fail(ExitCode::failure,
                    fmt::format("{} of {} tasks failed; run the same command again to finish the rest",
                                failed.load(), job.open.size()));
    }
    if (!job.last.empty() && !run_task(k_last_task, job.last, job.folder))
        return static_cast<int>(ExitCode::failure);
    return 0;
}
