// Scenes that tests render in their own process.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

import candela.core;

// Asked here, because clang 19 otherwise declares the implicit destructor of Rgb once for each module that
// has it, when it comes to that of a CompiledScene.
static_assert(std::is_destructible_v<candela::Rgb>);

/// A scene as it was read, and with its models and triangles.
struct Compiled {
    candela::Scene source;
    candela::CompiledScene scene;
};

/// Fails the test, with the diagnostics, where the scene is not valid.
Compiled compiled(const candela::SceneRequest& request);

/// The same for the text of a scene file.
Compiled compiled(const std::string& text, const std::vector<candela::Setting>& settings = {});
