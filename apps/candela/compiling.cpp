#include "compiling.h"

#include <optional>

#include "reporting.h"
#include "terminal.h"

std::optional<candela::CompiledScene> compile_scene(const candela::SceneDraft& draft,
                                                    candela::Registry& registry,
                                                    candela::Diagnostics& diagnostics, int threads) {
    ProgressBar bar("reading", !is_quiet());
    return candela::compile(draft, registry, diagnostics, threads, bar.updater());
}
