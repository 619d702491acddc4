#include "compiling.h"

#include <optional>
#include <vector>

#include "reporting.h"
#include "terminal.h"

std::optional<candela::CompiledScene> compile_scene(const candela::SceneDraft& draft,
                                                    candela::Registry& registry,
                                                    candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("reading", !is_quiet());
    return candela::compile(draft, registry, diagnostics, threads, bar.updater());
}

void check_all_frames(candela::SceneFrames& frames, const std::vector<int>& numbers,
                      candela::Registry& registry, candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("checking", !is_quiet());
    candela::check_frames(frames, numbers, registry, diagnostics, threads, bar.updater());
}
