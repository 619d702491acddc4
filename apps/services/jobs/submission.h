// A job to run: its plan, and the commands of its tasks.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "jobs/plan.h"

using Words = std::vector<std::string>;

/// A job to run, and the commands that do it.
struct Submission {
    JobPlan plan;
    JobFolder folder;
    std::vector<Words> commands;             // one per task of the plan
    Words last;                              // to run after all others; empty: none
    std::vector<std::size_t> open;           // indices of the unfinished tasks
    int threads = 1;                         // per task
    std::vector<std::string> queue_options;  // as for the queue's own command
};

/// A task's command, for a shell in any folder.
std::string shell_line(const Submission& job, const Words& command);

/// Throws candela::Error (bad_request) if a word of the job cannot be written to its files: scripts have a
/// command on each line, and a plan is JSON.
void require_plain_words(const Submission& job);
