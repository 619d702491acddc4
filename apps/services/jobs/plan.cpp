#include "jobs/plan.h"

#include <fmt/format.h>

#include <algorithm>

#include "files/output_folder.h"
#include "files/owned_files.h"
#include "json/json.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

// About 400,000 frames, and small enough to parse.
constexpr std::size_t k_largest_plan = std::size_t{64} << 20;

Json as_json(const JobFile& file) { return {{"path", file.path.string()}, {"inputs", file.inputs}}; }

JobFile file_from(const Json& json) { return {json.at("path").get<std::string>(), json.at("inputs")}; }

Json as_json(const JobPlan& plan) {
    Json tasks = Json::array();
    for (const JobTask& task : plan.tasks) {
        Json files = Json::array();
        for (const JobFile& file : task.files) files.push_back(as_json(file));
        tasks.push_back({{"name", task.name}, {"files", std::move(files)}});
    }
    Json results = Json::array();
    for (const fs::path& result : plan.results) results.push_back(result.string());
    const auto whole = plan.whole.path.empty() ? Json() : as_json(plan.whole);
    return {{"version", 1},
            {"directory", plan.directory.string()},
            {"output", plan.output},
            {"engine", plan.engine},
            {"number", plan.number},
            {"submitted", plan.submitted},
            {"tasks", std::move(tasks)},
            {"results", std::move(results)},
            {"whole", whole}};
}

JobPlan plan_from(const Json& json) {
    JobPlan plan{.directory = json.at("directory").get<std::string>(),
                 .output = json.at("output"),
                 .engine = json.at("engine"),
                 .number = json.at("number"),
                 .submitted = json.at("submitted"),
                 .tasks = {},
                 .results = {},
                 .whole = {}};
    if (const Json& whole = json.at("whole"); !whole.is_null()) plan.whole = file_from(whole);
    for (const Json& task : json.at("tasks")) {
        JobTask& made = plan.tasks.emplace_back(task.at("name").get<std::string>());
        // It becomes a file name in the job's folder.
        if (made.name.empty() || made.name.find('/') != std::string::npos)
            throw Error(ErrorCategory::failure, fmt::format("invalid task name '{}'", made.name));
        for (const Json& file : task.at("files")) made.files.push_back(file_from(file));
    }
    for (const Json& result : json.at("results")) plan.results.emplace_back(result.get<std::string>());
    return plan;
}

}  // namespace

JobFolder JobFolder::of_output(const fs::path& output) {
    return JobFolder(folder_of(output) / ".candela" / "jobs" / output.filename());
}

std::vector<JobFolder> JobFolder::all_in(const fs::path& directory) {
    const fs::path jobs = directory / ".candela" / "jobs";
    auto names = candela::names_in(jobs);
    if (!names || names->empty()) {
        throw Error(
            ErrorCategory::failure,
            fmt::format("no job was submitted for '{}': '{}' does not exist; submit one with candela submit",
                        directory.string(), jobs.string()));
    }
    std::ranges::sort(*names);
    std::vector<JobFolder> folders;
    for (const std::string& name : *names) folders.emplace_back(jobs / name);
    return folders;
}

void JobFolder::make() const {
    const fs::path jobs = path_.parent_path();
    make_owned_folder(folder_of(jobs.parent_path()),
                      jobs.parent_path().filename() / jobs.filename() / path_.filename());
}

void write_plan(const JobPlan& plan, const JobFolder& folder) {
    const std::string text = json_text(as_json(plan), 1) + '\n';
    if (text.size() > k_largest_plan) {
        throw Error(
            ErrorCategory::failure,
            fmt::format("the plan of {} tasks has {} MB; the maximum is {} MB: submit fewer frames at a "
                        "time with --frames",
                        plan.tasks.size(), text.size() >> 20, k_largest_plan >> 20));
    }
    folder.make();
    write_owned_file(folder.plan(), text);
}

JobPlan read_plan(const JobFolder& folder) {
    const auto text = read_owned_file(folder.plan(), k_largest_plan);
    if (!text) {
        throw Error(
            ErrorCategory::failure,
            fmt::format("'{}' cannot be read: expected a regular file of at most {} MB; submit the job "
                        "again",
                        folder.plan().string(), k_largest_plan >> 20));
    }
    const auto fail = [&](const std::exception& problem) {
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' is not a valid job plan: {}; submit the job again",
                                folder.plan().string(), problem.what()));
    };
    try {
        return plan_from(parse_json(*text));
    } catch (const Json::exception& problem) {
        fail(problem);
    } catch (const Error& problem) {
        fail(problem);
    }
    return {};
}
