// What animate does, and submit has done by others: which frames become which files.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "frame_pattern.h"

import candela.diagnostics;
import candela.film;
import candela.registry;
import candela.scene;

/// Where the frames go, and what films are made of them.
struct AnimationOutputs {
    std::optional<FramePattern> frames;  // nothing: they are kept no longer than the films take
    std::vector<std::filesystem::path> films;
};

/// Adds --output, --frames and --step.
void add_frames_options(CommandLine& line);

/// What --output says; frames/%04d.png where it is not given. Throws candela::Error (bad_request) for what
/// cannot be, and (failure) where a film needs a program that is not there.
AnimationOutputs animation_outputs_from(const CommandLine& line);

/// The format of the frames. Throws candela::Error (bad_request) if they cannot become a film and should.
candela::PictureFormat format_of_frames(const CommandLine& line, const AnimationOutputs& outputs,
                                        candela::Registry& registry);

/// The frames that --frames and --step choose, all validated; none if the scene is not animated, which is
/// reported with what else is wrong. Throws candela::Error (bad_request).
std::vector<int> checked_frames_from(const CommandLine& line, candela::SceneFrames& frames,
                                     candela::Registry& registry, candela::Diagnostics& diagnostics,
                                     int threads);

/// Throws candela::Error (bad_request) where a film, or one of these frames, would replace a file that the
/// scene is made from.
void require_no_input_among(const AnimationOutputs& outputs, candela::SceneFrames& frames,
                            const std::vector<int>& numbers);
