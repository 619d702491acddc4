#include "jobs/state.h"

#include <algorithm>
#include <system_error>

#include "files/owned_files.h"
#include "film/render_cache.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Links;
using State = JournalEntry::State;
using Kind = TaskState::Kind;

namespace {

/// The last non-empty line, where a queue writes why it ended a task.
std::string last_line_of(const fs::path& log) {
    constexpr std::size_t k_most = 4096;
    const std::string text = end_of_owned_file(log, k_most);
    const std::size_t end = text.find_last_not_of(" \t\r\n");
    if (end == std::string::npos) return "";
    const std::size_t before = text.find_last_of('\n', end);
    const std::size_t begin = before == std::string::npos ? 0 : before + 1;
    return text.substr(begin, end + 1 - begin);
}

/// Adds what the journal and the log say about a task that lacks files.
void add_what_is_said(TaskState& state, const fs::path& journal, const fs::path& log) {
    state.journal = read_journal(journal);
    if (!state.journal) return;
    switch (state.journal->state) {
        case State::running:
            state.kind = Kind::running;
            break;
        case State::lost: {
            state.kind = Kind::failed;
            const std::string said = last_line_of(log);
            state.why = state.journal->why + (said.empty() ? "" : "; its log ends with: " + said);
            break;
        }
        case State::failed:
            state.kind = Kind::failed;
            state.why = state.journal->why;
            break;
        case State::done:
            break;
    }
}

}  // namespace

std::size_t JobState::count(Kind kind) const {
    return static_cast<std::size_t>(std::ranges::count(tasks, kind, &TaskState::kind));
}

const char* name_of(Kind kind) {
    switch (kind) {
        case Kind::done:
            return "done";
        case Kind::running:
            return "running";
        case Kind::failed:
            return "failed";
        default:
            return "waiting";
    }
}

TaskState state_of(const JobPlan& plan, const JobTask& task, std::size_t number, const JobFolder& folder) {
    TaskState state{.name = task.name, .files = task.files.size(), .journal = {}, .why = {}};
    const JobFile& whole = plan.whole;
    const bool is_whole = !whole.path.empty() && recorded(plan.directory / whole.path, whole.inputs,
                                                          Links::followed) == CacheState::made;
    if (is_whole) state.files_done = state.files;
    for (const JobFile& file : task.files) {
        if (is_whole) break;
        const CacheState is = recorded(plan.directory / file.path, file.inputs, Links::not_followed);
        if (is == CacheState::made) ++state.files_done;
        if (is == CacheState::other) ++state.files_other;
    }
    if (state.files_done == state.files) {
        state.kind = Kind::done;
        state.journal = read_journal(folder.journal_of(task.name));
    } else {
        add_what_is_said(state, folder.journal_of(task.name), folder.log_of(std::to_string(number)));
    }
    return state;
}

JobState state_of(const JobFolder& folder) {
    JobState state{.plan = read_plan(folder), .tasks = {}, .last = {}};
    std::size_t number = 0;
    for (const JobTask& task : state.plan.tasks)
        state.tasks.push_back(state_of(state.plan, task, ++number, folder));
    if (state.plan.results.empty()) return state;
    TaskState last{.name = k_last_task, .files = state.plan.results.size(), .journal = {}, .why = {}};
    add_what_is_said(last, folder.journal_of(k_last_task), folder.log_of(k_last_task));
    for (const fs::path& result : state.plan.results) {
        std::error_code problem;
        if (fs::exists(state.plan.directory / result, problem)) ++last.files_done;
    }
    // Results older than the job have no journal of their own.
    if (last.journal && last.journal->state == State::done && last.files_done == last.files)
        last.kind = Kind::done;
    state.last = std::move(last);
    return state;
}
