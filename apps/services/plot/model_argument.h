// A model as named on the command line, and a scene that has it.
#pragma once

#include <string>
#include <utility>
#include <vector>

import candela.api;
import candela.plugins;
import candela.scene;

/// "reflection/phong:shininess=20,ks=0.5", "light/spot".
struct NamedModel {
    candela::PluginKind kind = candela::PluginKind::reflection;
    std::string name;
    std::vector<std::pair<std::string, std::string>> values{};  // parameters and values, as in a scene

    /// Without its kind: "phong:shininess=20".
    std::string label() const;
};

/// Parses a model; a reflection model's kind may be left out. Throws candela::Error (bad_request) if the text
/// is malformed or names a plugin that is neither a reflection model nor a light.
NamedModel model_from(const std::string& text, candela::Registry& registry);
/// Parses "shininess=20". Throws like model_from().
std::pair<std::string, std::string> value_from(const std::string& text);

/// A scene whose first object has the reflection model, or whose first light is the light. A light without a
/// position or direction is in the middle of a large room and shines downwards. Throws candela::Error
/// (bad_request) for invalid values, as in any scene.
candela::Scene scene_with(const NamedModel& model, candela::Registry& registry);
