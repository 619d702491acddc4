// Scenes that tests render in their own process.
#pragma once

#include <string>
#include <vector>

import candela.core;

/// A scene as it was read, and with its models and triangles.
struct Compiled {
    candela::Scene source;
    candela::CompiledScene scene;
};

/// Fails the test, with the diagnostics, where the scene is not valid.
Compiled compiled(const candela::SceneRequest& request);

/// The same for the text of a scene file.
Compiled compiled(const std::string& text, const std::vector<candela::Setting>& settings = {});
