// The state of a job, from files alone.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "jobs/heartbeat.h"
#include "jobs/plan.h"

struct TaskState {
    enum class Kind {
        done,     // all of its files are complete, and made from what was submitted
        running,  // some files may be done
        failed,   // or lost: its process no longer exists
        waiting   // not started yet, or it succeeded and its files are gone
    };
    std::string name;
    Kind kind = Kind::waiting;
    std::size_t files_done = 0;
    std::size_t files_other = 0;  // made from other inputs than were submitted
    std::size_t files = 0;
    std::optional<JournalEntry> journal;
    std::string why;  // why it failed
};

struct JobState {
    JobPlan plan;
    std::vector<TaskState> tasks;
    std::optional<TaskState> last;

    std::size_t count(TaskState::Kind kind) const;
};

/// The name of a kind, for people and for programs.
const char* name_of(TaskState::Kind kind);

/// Throws candela::Error (failure) if there is no plan.
JobState state_of(const JobFolder& folder);

/// The state of one task; `number` is counted from 1.
TaskState state_of(const JobPlan& plan, const JobTask& task, std::size_t number, const JobFolder& folder);
