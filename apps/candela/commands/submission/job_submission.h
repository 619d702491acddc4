// Jobs as the command line describes them.
#pragma once

#include <optional>
#include <string>

#include "cli/command_line.h"
#include "jobs/submission.h"

import candela.plugins;
import candela.scene;
import candela.util;

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
