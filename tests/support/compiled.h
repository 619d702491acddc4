// Scenes that tests render in their own process.
#pragma once

#include <string>
#include <type_traits>
#include <vector>

import candela.core;

// Instantiated here, because clang 19 otherwise declares the implicit destructor of Rgb once per module that
// has it, on reaching that of a RenderScene.
static_assert(std::is_destructible_v<candela::Rgb>);

/// A scene as read, and compiled with its models and triangles.
struct Compiled {
    candela::Scene source;
    candela::RenderScene scene;
};

/// Fails the test, with the diagnostics, if the scene is not valid.
Compiled compiled(const candela::SceneRequest& request);

/// Like the above, for the text of a scene file.
Compiled compiled(const std::string& text, const std::vector<candela::Setting>& settings = {});
