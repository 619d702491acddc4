#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "cli/completion.h"

import candela.api;
import candela.plugins;
import candela.util;

using candela::Parameter;
using candela::PluginKind;

namespace {

/// A path that can be set, and the known facts about its values.
struct Settable {
    std::string path;
    const Parameter* parameter;
    std::optional<PluginKind> names{};  // the value is a plugin's name
};

/// The path element for the `index`th object or light: its name, unless it has none or a path cannot contain
/// it.
std::string in_path(const std::string& name, std::size_t index) {
    const bool is_possible =
        !name.empty() && name.find_first_of(".=") == std::string_view::npos && can_be_shown(name);
    return is_possible ? name : std::to_string(index);
}

class Paths {
  public:
    explicit Paths(candela::Registry& registry) : registry_(registry) {}

    void add(const candela::TableSchema& table, const std::string& prefix) {
        for (const Parameter& parameter : table.parameters) {
            const auto key = std::ranges::find(table.plugins, parameter.name, &candela::PluginKey::key);
            found_.push_back({.path = prefix + parameter.name,
                              .parameter = &parameter,
                              .names = key == table.plugins.end() ? std::nullopt : std::optional(key->kind)});
        }
    }

    void add(PluginKind kind, const std::string& name, const std::string& prefix) {
        const candela::PluginFile* const file = registry_.find(kind, name);
        if (file == nullptr) return;
        for (const Parameter& parameter : file->manifest.parameters)
            found_.push_back({.path = prefix + parameter.name, .parameter = &parameter});
    }

    const std::vector<Settable>& found() const { return found_; }

  private:
    candela::Registry& registry_;
    std::vector<Settable> found_;
};

void add_scene(Paths& paths, const candela::Scene& scene) {
    for (const candela::TableSchema& table : candela::scene_schema()) {
        if (!table.repeated) {
            paths.add(table, table.name + '.');
        } else if (table.name == "light") {
            for (std::size_t i = 0; i < scene.lights.size(); ++i) {
                const candela::LightSource& light = scene.lights[i];
                const std::string prefix = "light." + in_path(light.label.name, i) + '.';
                paths.add(table, prefix);
                paths.add(PluginKind::light, light.model.name, prefix);
            }
        } else if (table.name == "object") {
            for (std::size_t i = 0; i < scene.objects.size(); ++i) {
                const candela::Object& object = scene.objects[i];
                const std::string prefix = "object." + in_path(object.label.name, i) + '.';
                paths.add(table, prefix);
                paths.add(PluginKind::shape, object.shape.name, prefix);
                paths.add(PluginKind::reflection, object.reflection.name, prefix + "material.");
                paths.add(candela::material_schema(), prefix + "material.");
            }
        }
    }
}

std::vector<Completion> values_of(const Settable& settable, candela::Registry& registry) {
    std::vector<Completion> result;
    const std::string before = settable.path + '=';
    if (settable.names) {
        for (const candela::PluginFile* const file : registry.list(*settable.names))
            result.push_back({before + file->manifest.name, file->manifest.summary});
    }
    for (const std::string& choice : settable.parameter->choices) result.push_back({before + choice});
    if (settable.parameter->type == candela::ParamType::boolean)
        for (const char* const word : {"true", "false"}) result.push_back({before + word});
    return result;
}

}  // namespace

std::vector<Completion> setting_completions(std::string_view typed, const candela::SceneRequest& request,
                                            candela::Registry& registry) {
    candela::SceneRequest lenient = request;
    lenient.use_defaults = true;
    lenient.ask = {};
    lenient.settings.clear();  // they include the one being typed
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(lenient, registry, diagnostics);
    Paths paths(registry);
    add_scene(paths, draft ? draft->scene : candela::Scene());

    const std::size_t equals = typed.find('=');
    if (equals != std::string_view::npos) {
        for (const Settable& settable : paths.found())
            if (settable.path == typed.substr(0, equals)) return values_of(settable, registry);
        return {};
    }
    // Up to the next part, as for folders.
    const std::size_t part = typed.rfind('.') + 1;  // 0 if there is none
    std::vector<Completion> result;
    for (const Settable& settable : paths.found()) {
        if (!settable.path.starts_with(typed)) continue;
        const std::size_t dot = settable.path.find('.', part);
        if (dot == std::string::npos) {
            result.push_back({settable.path + '=', settable.parameter->meaning});
        } else {
            result.push_back({settable.path.substr(0, dot + 1)});
        }
    }
    return result;
}
