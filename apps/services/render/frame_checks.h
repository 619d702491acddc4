// All frames are validated before the first one is rendered.
#pragma once

#include <span>

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

namespace candela {

/// Validates frames like build(), and reports every problem once: with the number of the first frame that
/// has it, unless all frames do, and with the track that causes it. `progress` counts frames.
void check_frames(SceneFrames& frames, std::span<const int> numbers, Registry& registry,
                  Diagnostics& diagnostics, int threads = 0, const Progress& progress = {});

}  // namespace candela
