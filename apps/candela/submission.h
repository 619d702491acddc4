// A job to run: its plan, and the commands of its tasks.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "job_plan.h"

import candela.diagnostics;
import candela.registry;
import candela.scene;

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

/// The first words of all commands of a job. `has_asked`: the user was asked for a model; a task cannot ask.
Words common_words(const CommandLine& line, const char* verb, bool has_asked);

/// Wraps the command to keep the journal of a job's task.
Words as_task(Words command, const JobFolder& folder, const std::string& task);

/// The request for a scene that tasks will read again. Sets `has_asked` if the user is asked. Throws
/// candela::Error (bad_request) if the scene can be read only once.
candela::SceneRequest repeatable_request_from(const CommandLine& line, candela::Registry& registry,
                                              bool& has_asked, Models models = Models::at_rest);

/// The parts of a picture, and the assembled picture. Otherwise like submission_of_frames().
std::optional<Submission> submission_of_parts(const CommandLine& line, int threads,
                                              candela::Diagnostics& diagnostics);

/// The frames of an animation, and films of them. Nothing if the scene has errors, which are reported. Throws
/// candela::Error.
std::optional<Submission> submission_of_frames(const CommandLine& line, int threads,
                                               candela::Diagnostics& diagnostics);
