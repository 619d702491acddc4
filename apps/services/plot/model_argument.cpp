#include "plot/model_argument.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "console/reporting.h"

import candela.util;

using candela::Error;
using candela::ErrorCategory;
using candela::PluginKind;

namespace {

constexpr const char* k_name = "plot";

/// Where a value was given, for diagnostics: "reflection/phong:ks".
std::string origin_of(const NamedModel& model, const std::string& parameter) {
    return fmt::format("{}:{}", candela::plugin_id(model.kind, model.name), parameter);
}

/// Reports values of parameters that the model does not have.
void report_unknown_values(const NamedModel& model, const candela::Manifest& manifest,
                           candela::Diagnostics& diagnostics) {
    candela::TableNode table;
    for (const auto& [name, value] : model.values) {
        const candela::SourceLocation place{origin_of(model, name), 0, 0, 0};
        table.entries.push_back({name, place, {place, value}});
    }
    std::vector<std::string> known;
    for (const candela::Parameter& p : manifest.parameters) known.push_back(p.name);
    const std::string id = candela::plugin_id(model.kind, model.name);
    report_unknown_keys(table, known, {id, {candela::Help::Topic::plugin, id}, {}}, diagnostics);
}

/// A request with the model's values, so that errors in them are found as in any scene.
candela::SceneRequest request_for(const NamedModel& model, const candela::Manifest& manifest) {
    const bool is_light = model.kind == PluginKind::light;
    std::string light = "type = \"directional\"\ndirection = [0, -1, 0]\n";
    if (is_light) {
        light = fmt::format("type = \"{}\"\n", model.name);
        constexpr std::array<std::pair<const char*, const char*>, 2> k_usual = {
            {{"position", "[0, 0, 0]"}, {"direction", "[0, -1, 0]"}}};
        for (const auto& [name, value] : k_usual) {
            const bool is_required = std::ranges::any_of(
                manifest.parameters, [&](const auto& p) { return p.name == name && !p.default_value; });
            if (is_required) light += fmt::format("{} = {}\n", name, value);
        }
    }
    candela::SceneRequest request;
    request.files = {k_name};
    request.streams[k_name] = fmt::format(
        "version = 1\n[room]\nheight = 1000\nwidth = 1000\ndepth = 1000\n[observer]\nposition = [0, 0, 404]\n"
        "look_at = [0, 0, 400]\n[shading]\nmodel = \"phong\"\n[reflection]\nmodel = \"{}\"\n[[light]]\n{}"
        "[[object]]\ntype = \"sphere\"\nposition = [0, 0, 400]\ncolor = [255, 255, 255]\n",
        is_light ? "phong" : model.name, light);
    for (const auto& [name, value] : model.values) {
        request.settings.push_back(
            {origin_of(model, name), (is_light ? "light.0." : "object.0.material.") + name, value});
    }
    return request;
}

}  // namespace

candela::Scene scene_with(const NamedModel& model, candela::Registry& registry) {
    const candela::PluginFile& file = registry.require(model.kind, model.name);
    candela::Diagnostics diagnostics;
    report_unknown_values(model, file.manifest, diagnostics);
    if (diagnostics.has_errors()) throw usage_error(diagnostics);
    auto scene = candela::read_scene(request_for(model, file.manifest), registry, diagnostics);
    if (scene) return *std::move(scene);
    throw usage_error(diagnostics);
}

std::string NamedModel::label() const {
    std::string text = name;
    for (const auto& [key, value] : values)
        text += fmt::format("{}{}={}", &values.front().first == &key ? ":" : ",", key, value);
    return text;
}

std::pair<std::string, std::string> value_from(const std::string& text) {
    const std::size_t equals = text.find('=');
    if (equals == 0 || equals == std::string::npos)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' is not a value; expected NAME=VALUE, as in ks=0.5", text));
    return {text.substr(0, equals), text.substr(equals + 1)};
}

NamedModel model_from(const std::string& text, candela::Registry& registry) {
    const std::size_t colon = text.find(':');
    std::string name = text.substr(0, colon);
    PluginKind kind = PluginKind::reflection;
    if (candela::is_kernel_file(name)) {
        kind = registry.require_kernel(name).manifest.kind;
        if (kind != PluginKind::reflection && kind != PluginKind::light)
            throw Error(ErrorCategory::bad_request,
                        fmt::format("'{}' cannot be plotted; expected a reflection model or a light", name));
    } else if (const std::size_t slash = name.find('/'); slash != std::string::npos) {
        const auto named = candela::plugin_kind_named(name.substr(0, slash));
        if (named != PluginKind::reflection && named != PluginKind::light) {
            throw Error(ErrorCategory::bad_request,
                        fmt::format("'{}' cannot be plotted; expected a reflection model or a light{}", name,
                                    candela::kernel_file_hint(name)));
        }
        kind = *named;
        name.erase(0, slash + 1);
    }
    NamedModel model{.kind = kind, .name = name};
    if (colon == std::string::npos) return model;
    // Commas within brackets belong to a value.
    int depth = 0;
    std::string part;
    for (const char c : text.substr(colon + 1) + ",") {
        if (c == ',' && depth == 0) {
            model.values.push_back(value_from(part));
            part.clear();
            continue;
        }
        depth += c == '[' ? 1 : c == ']' ? -1 : 0;
        part += c;
    }
    return model;
}
