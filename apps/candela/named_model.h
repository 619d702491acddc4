// A model as a person names it on the command line, and a scene that has it.
#pragma once

#include <string>
#include <utility>
#include <vector>

import candela.descriptor;
import candela.registry;
import candela.scene;

/// "reflection/phong:shininess=20,ks=0.5", "light/spot".
struct NamedModel {
    candela::PluginKind kind = candela::PluginKind::reflection;
    std::string name;
    std::vector<std::pair<std::string, std::string>> values{};  // parameters and values, as in a scene

    /// Without its kind: "phong:shininess=20".
    std::string label() const;
};

/// The kind may be left out for a reflection model. Throws candela::Error (bad_request) for what is no such
/// text, or another kind of plugin than a reflection model or a light.
NamedModel model_from(const std::string& text);
/// "shininess=20". Throws likewise.
std::pair<std::string, std::string> value_from(const std::string& text);

/// A scene whose first object has the reflection model, or whose first light is the light; a light whose
/// place or direction is not among the values is in the middle of a large room and shines downwards. Throws
/// candela::Error (bad_request) for what is wrong with the values, as it would be wrong in a scene.
candela::Scene scene_with(const NamedModel& model, candela::Registry& registry);
