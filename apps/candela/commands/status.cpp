// candela status: shows the progress of submitted jobs.
#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "jobs/plan.h"
#include "jobs/state.h"
#include "json/json.h"

import candela.util;

using Kind = TaskState::Kind;

namespace {

constexpr std::size_t k_most_shown = 20;

std::string counted(std::size_t count, const char* what) {
    return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

std::string details(const TaskState& task) {
    std::string text = fmt::format("    {}", task.name);
    if (task.files > 1) text += fmt::format(", {} of {} done", task.files_done, task.files);
    if (task.kind == Kind::running)
        text += fmt::format(", on {} since {}", task.journal->host, task.journal->began);
    if (!task.why.empty()) {
        text += ": ";
        for (const char c : task.why.substr(0, task.why.find_last_not_of('\n') + 1))
            text += c == '\n' ? "\n      " : std::string(1, c);
    }
    return text + '\n';
}

std::string text_of(const JobState& job) {
    const JobPlan& plan = job.plan;
    std::size_t files = 0, done = 0, other = 0;
    for (const TaskState& task : job.tasks) {
        files += task.files;
        done += task.files_done;
        other += task.files_other;
    }
    std::string text = fmt::format("{}: {} of {} done, in {}; {}{}, submitted {}\n", plan.output, done,
                                   counted(files, "file"), counted(job.tasks.size(), "task"), plan.engine,
                                   plan.number.empty() ? "" : " job " + plan.number, plan.submitted);
    if (other > 0) {
        text += fmt::format(
            "  {} made from other inputs than were submitted: the scene, a file or Candela has changed\n",
            counted(other, "file"));
    }
    for (const Kind kind : {Kind::done, Kind::running, Kind::failed, Kind::waiting}) {
        const std::size_t count = job.count(kind);
        if (count == 0) continue;
        text += fmt::format("  {:8} {}\n", name_of(kind), counted(count, "task"));
        if (kind != Kind::running && kind != Kind::failed) continue;
        std::size_t shown = 0;
        for (const TaskState& task : job.tasks) {
            if (task.kind != kind) continue;
            if (++shown > k_most_shown) {
                text += fmt::format("    and {} more\n", count - k_most_shown);
                break;
            }
            text += details(task);
        }
    }
    if (job.last) {
        std::string results;
        for (const auto& result : plan.results) results += (results.empty() ? "" : ", ") + result.string();
        text += fmt::format("  {}: {}{}\n", results, name_of(job.last->kind),
                            job.last->why.empty() ? "" : ": " + job.last->why);
    }
    if (job.count(Kind::failed) > 0 || (job.last && job.last->kind == Kind::failed))
        text += "  Run the same candela submit command again to finish the rest.\n";
    return text;
}

Json json_of(const TaskState& task) {
    Json json{{"name", task.name},
              {"state", name_of(task.kind)},
              {"files", task.files},
              {"files_done", task.files_done},
              {"files_made_from_something_else", task.files_other}};
    if (task.journal) {
        json["host"] = task.journal->host;
        json["began"] = task.journal->began;
        json["seconds"] = task.journal->seconds;
    }
    if (!task.why.empty()) json["why"] = task.why;
    return json;
}

Json json_of(const JobState& job) {
    Json tasks = Json::array();
    for (const TaskState& task : job.tasks) tasks.push_back(json_of(task));
    Json json{{"output", job.plan.output},
              {"engine", job.plan.engine},
              {"number", job.plan.number},
              {"submitted", job.plan.submitted}};
    for (const Kind kind : {Kind::done, Kind::running, Kind::failed, Kind::waiting})
        json[name_of(kind)] = job.count(kind);
    json["tasks"] = std::move(tasks);
    if (job.last) json["last"] = json_of(*job.last);
    return json;
}

}  // namespace

int run_status(const std::vector<std::string>& arguments) {
    CommandLine line("candela status [DIR] [options]",
                     "Show the jobs that were submitted for a folder, by default this one: what is done, "
                     "running and waiting, and what failed and why. Only the folder's files are read.");
    line.positional("directory", 1);
    line.options()("json", "print the state as JSON");
    if (!line.parse(arguments)) return 0;
    const std::vector<std::string> given = line.all("directory");
    std::vector<JobState> jobs;
    int code = 0;
    for (const JobFolder& folder : JobFolder::all_in(given.empty() ? "." : given.front())) {
        try {
            jobs.push_back(state_of(folder));
        } catch (const candela::Error& problem) {
            code = fail(exit_code_of(problem.category()), problem.what());  // the other jobs are still shown
        }
    }
    if (line.has("json")) {
        Json json = Json::array();
        for (const JobState& job : jobs) json.push_back(json_of(job));
        std::cout << json_text(json, 2) << '\n';
    } else {
        for (const JobState& job : jobs) std::cout << text_of(job);
    }
    return code;
}
