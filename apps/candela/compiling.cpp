#include "compiling.h"

#include <optional>
#include <vector>

#include "command_line.h"
#include "reporting.h"
#include "terminal.h"

std::optional<candela::CompiledScene> compile_scene(const candela::SceneDraft& draft,
                                                    candela::Registry& registry,
                                                    candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("reading", !is_quiet());
    auto compiled = candela::compile(draft, registry, diagnostics, threads, bar.updater());
    forget_triangles_of_models();
    return compiled;
}

void check_all_frames(candela::SceneFrames& frames, const std::vector<int>& numbers,
                      candela::Registry& registry, candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("checking", !is_quiet());
    candela::check_frames(frames, numbers, registry, diagnostics, threads, bar.updater());
}
