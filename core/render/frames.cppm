// The frames of an animated scene, built one after the other.
module;

#include "candela/plugin/export.h"

#include <memory>

export module candela.render:frames;

import :render_scene;
import candela.plugins;
import candela.scene;
import candela.util;

export namespace candela {

/// Builds one frame after the other, like build(), and carries over to the next whatever has not changed:
/// triangles, lights, models, the environment. Constraints are checked again only if something has moved. One
/// thread at a time.
class CANDELA_EXPORT FrameBuilder {
  public:
    explicit FrameBuilder(Registry& registry);
    FrameBuilder(FrameBuilder&&) noexcept;
    FrameBuilder& operator=(FrameBuilder&&) noexcept;
    ~FrameBuilder();

    /// Valid until the next call; null if there were errors. `threads`: as in RenderOptions.
    const RenderScene* build(const SceneDraft& draft, Diagnostics& diagnostics, int threads = 0);
    /// Whether all triangles are where they were in the previous frame. If not, a Renderer must forget().
    bool has_kept_triangles() const noexcept;

  private:
    struct Kept;
    std::unique_ptr<Kept> kept_;
};

}  // namespace candela
