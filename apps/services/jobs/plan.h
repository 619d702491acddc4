// A job: a film's frames or a picture's parts as tasks, which any number of processes share, and a last task
// that puts the results together. Its plan is a file next to the output.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// A file that a task makes, and the fingerprint of its inputs.
struct JobFile {
    std::filesystem::path path;
    std::string inputs;
};

struct JobTask {
    std::string name;  // "0..9"; also names the journal
    std::vector<JobFile> files;
};

/// Paths are relative to `directory`, in which all commands run.
struct JobPlan {
    std::filesystem::path directory;
    std::string output;  // as given: "frames/%04d.png"
    std::string engine;
    std::string number;     // given by the engine; may be empty
    std::string submitted;  // UTC, ISO 8601
    std::vector<JobTask> tasks;
    std::vector<std::filesystem::path> results;  // of the last task; empty: there is no last task
    /// If this file is up to date, all tasks are done: the assembled picture, whose parts are gone. An empty
    /// path if there is none.
    JobFile whole;
};

/// The folder of everything known about a job: .candela/jobs/<name of the output>, next to the output.
class JobFolder {
  public:
    explicit JobFolder(std::filesystem::path path) : path_(std::move(path)) {}
    static JobFolder of_output(const std::filesystem::path& output);
    /// All job folders next to the contents of `directory`, by name. Throws candela::Error (failure) if it
    /// cannot be read.
    static std::vector<JobFolder> all_in(const std::filesystem::path& directory);

    const std::filesystem::path& path() const { return path_; }
    /// Creates the folder. Its path may contain links only up to the output's own folder. Throws
    /// candela::Error (failure).
    void make() const;
    std::filesystem::path plan() const { return path_ / "plan.json"; }
    std::filesystem::path journal_of(const std::string& task) const { return path_ / (task + ".json"); }
    /// The queue's log of a task's output. `task`: its number, from 1, or k_last_task.
    std::filesystem::path log_of(const std::string& task) const { return path_ / (task + ".log"); }
    /// One command line per task, for a shell.
    std::filesystem::path commands() const { return path_ / "tasks"; }
    /// The script that a queue runs for all tasks, and the one for the last task.
    std::filesystem::path script_of_tasks() const { return path_ / "tasks.sh"; }
    std::filesystem::path script_of_last() const { return path_ / "finish.sh"; }

  private:
    std::filesystem::path path_;
};

/// The name of the last task.
inline constexpr const char* k_last_task = "finish";

/// Throws candela::Error (failure).
void write_plan(const JobPlan& plan, const JobFolder& folder);
/// Throws candela::Error (failure) if the plan is missing or invalid.
JobPlan read_plan(const JobFolder& folder);
