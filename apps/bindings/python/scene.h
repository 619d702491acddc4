// Scenes for Python.
#pragma once

#include "binding.h"

#include "errors.h"
#include "registry.h"

import candela.render;
import candela.scene;

namespace candela::python {

/// Paths and values, as in candela::Setting.
using Settings = std::vector<std::pair<std::string, std::string>>;

/// A scene, read and checked, with its triangles. Immutable: any thread.
class ReadScene {
  public:
    /// Throws InvalidInput and Error.
    ReadScene(RegistryPointer registry, SceneRequest request, int threads);

    const RegistryPointer& registry() const noexcept { return registry_; }
    const SceneRequest& request() const noexcept { return request_; }
    const Scene& scene() const noexcept { return scene_; }
    const RenderScene& compiled() const noexcept { return compiled_; }
    const std::vector<Problem>& warnings() const noexcept { return warnings_; }
    int threads() const noexcept { return threads_; }

  private:
    RegistryPointer registry_;
    SceneRequest request_;
    int threads_;
    Scene scene_;
    RenderScene compiled_;
    std::vector<Problem> warnings_;
};

using ScenePointer = std::shared_ptr<const ReadScene>;

/// The request with more settings; a setting replaces an earlier one of the same path.
SceneRequest with_settings(SceneRequest request, const Settings& settings);

/// The scene, as far as it could be read. Throws InvalidInput if it has errors.
SceneDraft valid_draft(const SceneRequest& request, Registry& registry, Diagnostics& diagnostics);

}  // namespace candela::python
