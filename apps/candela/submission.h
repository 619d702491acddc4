// A job that is to be done: its plan, and the commands that do it.
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

/// A job that is to be done, and the commands that do it.
struct Submission {
    JobPlan plan;
    JobFolder folder;
    std::vector<Words> commands;             // of the plan's tasks
    Words last;                              // what is to be done when all are; empty: nothing
    std::vector<std::size_t> open;           // the tasks that are not done yet, by their index
    int threads = 1;                         // per task
    std::vector<std::string> queue_options;  // as the queue's own command takes them
};

/// A task's command for a shell in any folder.
std::string shell_line(const Submission& job, const Words& command);

/// Throws candela::Error (bad_request) where a word of the job cannot be in its files: scripts have a command
/// on each line, and a plan is JSON.
void require_plain_words(const Submission& job);

/// What all commands of a job begin with. `has_asked`: a person was asked for a model, and nobody asks a
/// task.
Words common_words(const CommandLine& line, const char* verb, bool has_asked);

/// The command as one that keeps the journal of a job's task.
Words as_task(Words command, const JobFolder& folder, const std::string& task);

/// The request for a scene that tasks will read again; `has_asked` is set where a person is asked. Throws
/// candela::Error (bad_request) if it can only be read once.
candela::SceneRequest repeatable_request_from(const CommandLine& line, candela::Registry& registry,
                                              bool& has_asked, Models models = Models::at_rest);

/// The parts of a picture, and the picture. Otherwise like submission_of_frames().
std::optional<Submission> submission_of_parts(const CommandLine& line, int threads,
                                              candela::Diagnostics& diagnostics);

/// The frames of an animation, and the films of them. Nothing where the scene has errors, which are reported.
/// Throws candela::Error.
std::optional<Submission> submission_of_frames(const CommandLine& line, int threads,
                                               candela::Diagnostics& diagnostics);
