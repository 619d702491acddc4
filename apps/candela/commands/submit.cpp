// candela submit: distributes tasks over any number of processes, on one machine or many.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <ctime>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <system_error>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "commands/animation_output.h"
#include "commands/submission/job_submission.h"
#include "commands/view_option.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "files/output_folder.h"
#include "files/owned_files.h"
#include "jobs/engines.h"
#include "jobs/heartbeat.h"
#include "jobs/plan.h"
#include "jobs/state.h"
#include "programs/shell_words.h"

import candela.api;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

enum class Engine { local, slurm, print };

struct EngineName {
    const char* name;
    Engine engine;
};
constexpr std::array k_engines = {EngineName{"local", Engine::local}, EngineName{"slurm", Engine::slurm},
                                  EngineName{"print", Engine::print}};

Engine engine_from(const CommandLine& line) {
    const auto name = line.get<std::string>("engine");
    for (const EngineName& each : k_engines)
        if (name == each.name) return each.engine;
    std::vector<std::string> names;
    for (const EngineName& each : k_engines) names.emplace_back(each.name);
    const std::string meant = candela::suggestion(name, names);
    throw Error(ErrorCategory::bad_request, fmt::format("--engine is '{}'; expected local, slurm or print{}",
                                                        name, meant.empty() ? "" : "; " + meant));
}

/// Writes the files that `status` reads and engines run. Removes the journals of an earlier job of the same
/// tasks.
void write_job(Submission& job, Engine engine) {
    job.folder.make();
    for (const std::size_t task : job.open) {
        std::error_code problem;
        fs::remove(job.folder.journal_of(job.plan.tasks[task].name), problem);
        fs::remove(job.folder.log_of(std::to_string(task + 1)), problem);
    }
    std::error_code problem;
    fs::remove(job.folder.journal_of(k_last_task), problem);
    write_plan(job.plan, job.folder);
    std::string commands;
    for (const Words& command : job.commands) commands += shell_line(job, command) + '\n';
    write_owned_file(job.folder.commands(), commands);
    if (engine != Engine::slurm) return;
    if (!job.open.empty()) write_owned_file(job.folder.script_of_tasks(), slurm_script_of_tasks(job));
    if (!job.last.empty()) write_owned_file(job.folder.script_of_last(), slurm_script_of_last(job));
}

/// The command would escape such characters when printing, and so name other files.
void require_printable_lines(const Submission& job) {
    const auto require = [&](const Words& command) {
        const std::string line = shell_line(job, command);
        if (candela::printable(line) == line) return;
        throw Error(
            ErrorCategory::bad_request,
            fmt::format(
                "'{}' contains characters that --engine print cannot print unchanged; use another name "
                "or value",
                candela::printable(line)));
    };
    for (const Words& command : job.commands) require(command);
    if (!job.last.empty()) require(job.last);
}

void print_command_lines(const Submission& job) {
    for (const std::size_t task : job.open) std::cout << shell_line(job, job.commands[task]) << '\n';
}

void show(const Submission& job, Engine engine) {
    if (engine != Engine::slurm) {
        print_command_lines(job);
        if (engine == Engine::local && !job.last.empty()) std::cout << shell_line(job, job.last) << '\n';
        return;
    }
    if (!job.open.empty()) {
        std::cout << "# sbatch " << quoted_for_shell(job.folder.script_of_tasks().string()) << '\n'
                  << slurm_script_of_tasks(job);
    }
    if (job.last.empty()) return;
    std::cout << "\n# sbatch " << (job.open.empty() ? "" : command_line_of(after_tasks("NUMBER")) + ' ')
              << quoted_for_shell(job.folder.script_of_last().string()) << '\n'
              << slurm_script_of_last(job);
}

std::string tasks_text(const Submission& job) {
    const std::size_t all = job.plan.tasks.size(), done = all - job.open.size();
    return fmt::format("{} task{}{}", all, all == 1 ? "" : "s",
                       done > 0 ? fmt::format(", {} of them already done", done) : "");
}

int hand_over(Submission& job, Engine engine, int processes) {
    const auto how_to_ask = [&] {
        return fmt::format("candela status {}", quoted_for_shell(folder_of(job.plan.output).string()));
    };
    switch (engine) {
        case Engine::local: {
            const int code = run_locally(job, static_cast<std::size_t>(processes));
            if (code == 0)
                say_afterwards([&] { return fmt::format("{}: {}\n", job.plan.output, tasks_text(job)); });
            return code;
        }
        case Engine::print:
            print_command_lines(job);
            say_afterwards([&] {
                return fmt::format(
                    "{}{}; {} shows their progress\n", tasks_text(job),
                    job.last.empty() ? "" : "; when all are done:\n" + shell_line(job, job.last) + '\n',
                    how_to_ask());
            });
            return 0;
        case Engine::slurm: {
            const std::vector<std::string> numbers = submit_to_slurm(job);
            if (!numbers.empty()) job.plan.number = numbers.front();
            write_plan(job.plan, job.folder);
            for (const std::string& number : numbers) std::cout << number << '\n';
            say_afterwards(
                [&] { return fmt::format("{}; {} shows their progress\n", tasks_text(job), how_to_ask()); });
            return 0;
        }
    }
    return 0;
}

}  // namespace

int run_submit(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela submit SCENE... [options]",
        "Distribute the frames of an animated scene, or the parts of a picture, over tasks. Each task is one "
        "candela animate or candela render, run on this machine, by a queue, or by anything that can run "
        "command lines. All frames of the scene are checked first. Finished tasks are left out, so run the "
        "same command again to finish the rest. Tasks need the scene and the folder of the pictures; running "
        "one twice or concurrently is harmless (docs/user/animation.md).");
    add_frames_options(line);
    line.options()("engine", po::value<std::string>()->value_name("NAME")->default_value("local"),
                   "what runs the tasks: local: this machine; slurm: sbatch; print: anything that runs the "
                   "printed command "
                   "lines, one per task")("jobs", po::value<int>()->value_name("N"),
                                          "local: tasks to run at a time; default: all cores")(
        "threads", po::value<int>()->value_name("N"),
        "threads per task; default: 1, or the cores divided by --jobs")(
        "chunk", po::value<int>()->value_name("N"),
        "frames per task; default: 10, or more to limit the tasks to 1000")(
        "parts", po::value<int>()->value_name("N"),
        "render one picture in N parts instead of frames; the last task assembles them")(
        "slurm", po::value<std::vector<std::string>>()->value_name("OPTION"),
        "an option for sbatch, such as --slurm=--partition=render; can be repeated")(
        "dry-run", "only print the job scripts or command lines");
    add_frame_option(line);
    add_scene_options(line);
    add_view_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("scene")) throw Error(ErrorCategory::bad_request, "candela submit needs a scene file");
    const Engine engine = engine_from(line);
    for (const auto& [option, of] : {std::pair("jobs", Engine::local), std::pair("slurm", Engine::slurm)}) {
        if (line.has(option) && engine != of)
            throw Error(ErrorCategory::bad_request, fmt::format("--{} applies only to --engine {}", option,
                                                                of == Engine::local ? "local" : "slurm"));
    }
    const int cores = candela::available_threads();
    const int processes = line.has("jobs") ? count_from(line, "jobs", 1024) : cores;
    const int threads = line.has("threads")       ? threads_from(line)
                        : engine == Engine::local ? std::max(1, cores / processes)
                                                  : 1;

    candela::Diagnostics diagnostics;
    if (line.has("frame") && !line.has("parts"))
        throw Error(ErrorCategory::bad_request,
                    "--frame applies only to --parts; use --frames 7 to choose one frame of many");
    auto job = line.has("parts") ? submission_of_parts(line, threads, diagnostics)
                                 : submission_of_frames(line, threads, diagnostics);
    report(diagnostics);
    if (!job) return static_cast<int>(exit_code_of(diagnostics));
    job->threads = threads;
    job->queue_options = line.all("slurm");
    job->plan.directory = fs::current_path();
    job->plan.engine = line.get<std::string>("engine");
    job->plan.submitted = date_text(std::time(nullptr));
    require_plain_words(*job);
    if (engine == Engine::slurm) require_folder_for_slurm(*job);
    if (engine == Engine::print) require_printable_lines(*job);
    for (std::size_t i = 0; i < job->plan.tasks.size(); ++i) {
        if (state_of(job->plan, job->plan.tasks[i], i + 1, job->folder).kind != TaskState::Kind::done)
            job->open.push_back(i);
    }
    if (line.has("dry-run")) {
        show(*job, engine);
        return 0;
    }
    write_job(*job, engine);
    return hand_over(*job, engine, processes);
}
