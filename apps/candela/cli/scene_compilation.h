// Compiling scenes while a person watches.
#pragma once

#include <optional>
#include <vector>

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

/// candela::build() with a progress bar if it takes long.
std::optional<candela::RenderScene> compile_scene(const candela::SceneDraft& draft,
                                                  candela::Registry& registry,
                                                  candela::Diagnostics& diagnostics, int threads = 0);

/// candela::check_frames() with a progress bar if it takes long.
void check_all_frames(candela::SceneFrames& frames, const std::vector<int>& numbers,
                      candela::Registry& registry, candela::Diagnostics& diagnostics, int threads = 0);
