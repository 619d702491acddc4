// Runs the tasks of a job as a Slurm array job.
#include <fmt/format.h>

#include <string>

#include "film/frame_pattern.h"
#include "jobs/engines.h"
#include "process/process.h"
#include "programs/shell_words.h"

import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// "1-3,7": numbers, counted from 1, of ascending indices.
std::string array_of(const std::vector<std::size_t>& indices) {
    std::string text;
    for (std::size_t i = 0; i < indices.size();) {
        std::size_t end = i + 1;
        while (end < indices.size() && indices[end] == indices[end - 1] + 1) ++end;
        text += fmt::format("{}{}", text.empty() ? "" : ",", indices[i] + 1);
        if (end > i + 1) text += fmt::format("-{}", indices[end - 1] + 1);
        i = end;
    }
    return text;
}

fs::path absolute(const Submission& job, const fs::path& path) {
    return (job.plan.directory / path).lexically_normal();
}

/// The lines at the start of all scripts. `log` may contain Slurm's patterns.
std::string head(const Submission& job, const std::string& log, const std::string& more) {
    std::string text = "#!/bin/sh\n#SBATCH --job-name=candela\n" + more;
    text += fmt::format("#SBATCH --cpus-per-task={}\n", job.threads);
    // A task may start again on another machine, and keeps what it has done.
    text += "#SBATCH --requeue\n";
    text += fmt::format("#SBATCH --output=\"{}\"\n", log);
    for (const std::string& option : job.queue_options) text += fmt::format("#SBATCH {}\n", option);
    return text;
}

std::string submit(const fs::path& script, const Words& more) {
    Words words = {"sbatch", "--parsable"};
    words.insert(words.end(), more.begin(), more.end());
    words.push_back(script.string());  // absolute, so that it does not look like an option
    const candela::ProgramOutput done = candela::run_program(words);
    if (done.exit_code != 0)
        throw Error(ErrorCategory::failure,
                    fmt::format("sbatch refused '{}':\n{}", script.string(), done.err));
    // "12", or "12;cluster".
    return done.out.substr(0, done.out.find_first_of(";\n"));
}

}  // namespace

void require_folder_for_slurm(const Submission& job) {
    const std::string folder = absolute(job, job.folder.path()).string();
    // A backslash in a log's name would also switch off its patterns.
    if (folder.find_first_of("\"\\") == std::string::npos) return;
    throw Error(
        ErrorCategory::bad_request,
        fmt::format(
            "'{}' contains a quotation mark or a backslash, which sbatch does not accept in the path of a "
            "log; use another folder",
            folder));
}

std::string slurm_script_of_tasks(const Submission& job) {
    const std::string logs = escaped_for_pattern(absolute(job, job.folder.path()).string());
    return head(job, logs + "/%a.log", fmt::format("#SBATCH --array={}\n", array_of(job.open))) +
           fmt::format("eval \"$(sed -n \"${{SLURM_ARRAY_TASK_ID}}p\" {})\"\n",
                       quoted_for_shell(absolute(job, job.folder.commands()).string()));
}

std::string slurm_script_of_last(const Submission& job) {
    const fs::path log = absolute(job, job.folder.log_of(k_last_task));
    return head(job, escaped_for_pattern(log.string()), "") + shell_line(job, job.last) + '\n';
}

Words after_tasks(const std::string& number) {
    // Without the second option, it would wait forever for failed tasks.
    return {"--dependency=afterok:" + number, "--kill-on-invalid-dep=yes"};
}

std::vector<std::string> submit_to_slurm(const Submission& job) {
    if (!candela::program_called("sbatch")) {
        throw Error(ErrorCategory::failure,
                    "sbatch, which submits jobs to Slurm, is not installed (Debian, Ubuntu: apt install "
                    "slurm-client); --dry-run shows the scripts");
    }
    std::vector<std::string> numbers;
    if (!job.open.empty()) numbers.push_back(submit(absolute(job, job.folder.script_of_tasks()), {}));
    if (!job.last.empty()) {
        numbers.push_back(submit(absolute(job, job.folder.script_of_last()),
                                 numbers.empty() ? Words() : after_tasks(numbers.front())));
    }
    return numbers;
}
