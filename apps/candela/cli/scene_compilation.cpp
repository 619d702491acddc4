#include "cli/scene_compilation.h"

#include <atomic>
#include <cstddef>
#include <optional>
#include <vector>

#include "cli/model_scene.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "render/frame_checks.h"

std::optional<candela::RenderScene> compile_scene(const candela::SceneDraft& draft,
                                                  candela::Registry& registry,
                                                  candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("reading", !is_quiet());
    // Placing the shapes is the first of three steps. After it, the models' source data only takes up memory.
    std::atomic<bool> are_placed{false};
    const auto tell = [&](std::size_t done, std::size_t all) {
        if (done >= all / 3 && !are_placed.exchange(true)) forget_triangles_of_models();
        bar.update(done, all);
    };
    auto compiled = candela::build(draft, registry, diagnostics, threads, tell);
    forget_triangles_of_models();
    return compiled;
}

void check_all_frames(candela::SceneFrames& frames, const std::vector<int>& numbers,
                      candela::Registry& registry, candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("checking", !is_quiet());
    candela::check_frames(frames, numbers, registry, diagnostics, threads, bar.updater());
}
