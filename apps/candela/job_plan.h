// A job: a film's frames, or a picture's parts, as tasks that any number of processes work on, and a last one
// that makes a whole of what they made. Its plan is a file beside what is made.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

/// A file that a task makes, and the fingerprint of what it is to be made from.
struct JobFile {
    std::filesystem::path path;
    std::string inputs;
};

struct JobTask {
    std::string name;  // "0..9", of the journal as well
    std::vector<JobFile> files;
};

/// Paths are relative to `directory`, in which all commands are run.
struct JobPlan {
    std::filesystem::path directory;
    std::string output;  // as it was given: "frames/%04d.png"
    std::string engine;
    std::string number;     // that the engine gave the job; may be empty
    std::string submitted;  // UTC, ISO 8601
    std::vector<JobTask> tasks;
    std::vector<std::filesystem::path> results;  // of the last task; none: there is no last task
    /// What makes all tasks done: the assembled picture, whose parts are gone. No path: there is none.
    JobFile whole;
};

/// Where everything is that is known of a job: .candela/jobs/<name of the output> beside the output.
class JobFolder {
  public:
    explicit JobFolder(std::filesystem::path path) : path_(std::move(path)) {}
    static JobFolder of_output(const std::filesystem::path& output);
    /// All that are beside what is in `directory`, by name. Throws candela::Error (failure) if it cannot be
    /// read.
    static std::vector<JobFolder> all_in(const std::filesystem::path& directory);

    const std::filesystem::path& path() const { return path_; }
    /// Makes the folder; no part of it but the output's own folder may be a link. Throws candela::Error
    /// (failure).
    void make() const;
    std::filesystem::path plan() const { return path_ / "plan.json"; }
    std::filesystem::path journal_of(const std::string& task) const { return path_ / (task + ".json"); }
    /// What a queue has caught of what a task printed. `task`: its number, from 1, or k_last_task.
    std::filesystem::path log_of(const std::string& task) const { return path_ / (task + ".log"); }
    /// One command line per task, for a shell.
    std::filesystem::path commands() const { return path_ / "tasks"; }
    /// What a queue is given for all tasks, and for the last.
    std::filesystem::path script_of_tasks() const { return path_ / "tasks.sh"; }
    std::filesystem::path script_of_last() const { return path_ / "finish.sh"; }

  private:
    std::filesystem::path path_;
};

/// The name of the last task.
inline constexpr const char* k_last_task = "finish";

/// Throws candela::Error (failure).
void write_plan(const JobPlan& plan, const JobFolder& folder);
/// Throws candela::Error (failure) if it is not there or is none.
JobPlan read_plan(const JobFolder& folder);
