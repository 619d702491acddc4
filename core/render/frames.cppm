// The frames of an animated scene, compiled one after the other.
module;

#include "candela/plugin/export.h"

#include <functional>
#include <memory>
#include <span>

export module candela.render:frames;

import :compiled_scene;
import candela.plugins;
import candela.scene;
import candela.util;

export namespace candela {

/// Compiles one frame after the other, like compile(), and carries over to the next whatever has not changed:
/// triangles, lights, models, the environment. Constraints are checked again only if something has moved. One
/// thread at a time.
class CANDELA_EXPORT FrameCompiler {
  public:
    explicit FrameCompiler(Registry& registry);
    FrameCompiler(FrameCompiler&&) noexcept;
    FrameCompiler& operator=(FrameCompiler&&) noexcept;
    ~FrameCompiler();

    /// Valid until the next call; null if there were errors. `threads`: as in RenderOptions.
    const CompiledScene* compile(const SceneDraft& draft, Diagnostics& diagnostics, int threads = 0);
    /// Whether all triangles are where they were in the previous frame. If not, a Renderer must forget().
    bool has_kept_triangles() const noexcept;

  private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

/// Validates frames like compile(), and reports every problem once: with the number of the first frame that
/// has it, unless all frames do, and with the track that causes it. `progress` counts frames.
CANDELA_EXPORT void check_frames(SceneFrames& frames, std::span<const int> numbers, Registry& registry,
                                 Diagnostics& diagnostics, int threads = 0, const Progress& progress = {});

}  // namespace candela
