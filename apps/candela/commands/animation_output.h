// Shared by animate and submit: the frames to render, and their files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "film/frame_pattern.h"

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

/// The files for the frames and the films made from them.
struct AnimationOutputs {
    std::optional<FramePattern> frames;  // nothing: deleted once the films are made
    std::vector<std::filesystem::path> films;
};

/// Adds --output, --frames and --step.
void add_frames_options(CommandLine& line);

/// Reads --output; its default is frames/%04d.png. Throws candela::Error: bad_request for unusable names,
/// failure if a film needs a program that is not installed.
AnimationOutputs animation_outputs_from(const CommandLine& line);

/// The format of the frames. Throws candela::Error (bad_request) if a film is wanted and cannot be made from
/// them.
candela::OutputFormat format_of_frames(const CommandLine& line, const AnimationOutputs& outputs,
                                       candela::Registry& registry);

/// The frames that --frames and --step choose, all validated. Empty if the scene is not animated; that is
/// reported with the scene's other errors. Throws candela::Error (bad_request).
std::vector<int> checked_frames_from(const CommandLine& line, candela::SceneFrames& frames,
                                     candela::Registry& registry, candela::Diagnostics& diagnostics,
                                     int threads);

/// Throws candela::Error (bad_request) if a film or one of these frames would overwrite a file that the scene
/// is made from.
void require_no_input_among(const AnimationOutputs& outputs, candela::SceneFrames& frames,
                            const std::vector<int>& numbers);
