// A validated scene as targets see it.
#pragma once

#include <cstddef>
#include <cstdint>  // before <memory>, whose std::align depends on it
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

import candela.api;
import candela.plugins;
import candela.scene;

namespace candela {

/// Models to switch to, in addition to those of the scene: names of reflection or shading models ("phong" is
/// both), ids such as "shading/flat", or "all", which means all that the target supports.
using ExtraModels = std::vector<std::string>;

/// The scene with all its objects switched to that shading or reflection model, or nothing if that would be
/// invalid.
using WithModel = std::function<std::optional<Scene>(PluginKind kind, const std::string& name)>;

/// A request for an export.
struct ExportRequest {
    std::string title{};
    TargetAbilities abilities{};  // the target's
    ExtraModels extra_models{};
    WithModel with_model{};  // if empty, extra models have their defaults
    /// Opacity, the second texture coordinates and attributes of vertices are left out if the target lacks
    /// them.
    bool leaves_out = false;
};

/// An ExportedScene and all its memory.
class SceneExport {
  public:
    /// Loads the plugins of `scene`. Throws Error if the target cannot express it, and (usage) if an extra
    /// model is unknown. `registry` must outlive this.
    SceneExport(const Scene& scene, const ExportRequest& request, Registry& registry);
    SceneExport(SceneExport&&) noexcept;
    SceneExport& operator=(SceneExport&&) noexcept;
    ~SceneExport();

    const ExportedScene& scene() const noexcept;
    /// Sentences for FileSink::approximate() about the parts that are left out (see ExportRequest).
    std::span<const char* const> left_out() const noexcept;

  private:
    struct Storage;
    std::unique_ptr<Storage> storage_;
};

}  // namespace candela
