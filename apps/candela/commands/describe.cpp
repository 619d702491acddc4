// candela describe: shows a plugin's manifest.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "console/wrapping.h"
#include "json/json.h"

import candela.util;

using candela::Error;
using candela::ErrorCategory;

namespace {

/// The plugin "reflection/phong"; a name alone suffices if only one kind has it.
const candela::PluginFile& plugin_called(const std::string& id, candela::Registry& registry) {
    if (candela::is_kernel_file(id)) return registry.require_kernel(id);
    const auto slash = id.find('/');
    if (slash != std::string::npos) {
        if (const auto kind = candela::plugin_kind_named(id.substr(0, slash)))
            return registry.require(*kind, id.substr(slash + 1));
    }
    std::vector<std::string> ids;
    std::vector<const candela::PluginFile*> of_that_name;
    for (const candela::PluginFile* file : registry.list()) {
        ids.push_back(file->manifest.id());
        if (file->manifest.name == id) of_that_name.push_back(file);
    }
    if (of_that_name.size() == 1) return *of_that_name.front();
    if (of_that_name.size() > 1) {
        std::vector<std::string> possible;
        for (const candela::PluginFile* file : of_that_name) possible.push_back(file->manifest.id());
        throw Error(ErrorCategory::bad_request,
                    fmt::format("'{}' may be {}", id, fmt::join(possible, " or ")));
    }
    const std::string meant = candela::suggestion(id, ids);
    throw Error(ErrorCategory::bad_request,
                fmt::format("unknown plugin '{}'{}; {}", id, candela::kernel_file_hint(id),
                            meant.empty() ? "candela list shows all" : meant));
}

/// Keeps line breaks: a formula is laid out.
std::string indented(const std::string& text) {
    std::string result;
    std::istringstream lines(text);
    lines.exceptions(std::ios::badbit);  // or std::getline() swallows std::bad_alloc, and the rest is lost
    for (std::string line; std::getline(lines, line);)
        result += "  " + wrapped(candela::printable(line), 2, 4) + '\n';
    return result;
}

/// "0.5 m"; "[255, 255, 255]"
std::string with_unit(const std::string& value, const std::string& unit) {
    return unit.empty() ? value : value + ' ' + unit;
}

/// "a number, at least 0; default 1 m", "three numbers, a position in metres; required".
std::string what_is_allowed(const candela::Parameter& p) {
    const std::string allowed = candela::constraint_text(p);
    if (p.default_value)
        return fmt::format("{}; default {}", allowed, with_unit(candela::text_of(*p.default_value), p.unit));
    const bool says_unit = p.unit.empty() || p.type == candela::ParamType::point;
    return fmt::format("{}{}; required", allowed, says_unit ? "" : ", in " + p.unit);
}

/// As in a scene file: "color = [255, 255, 255], ks = [0.9, 0.8, 0.4]".
std::string text_of(const candela::Preset& preset) {
    std::vector<std::string> parts;
    if (preset.color) parts.push_back("color = " + candela::text_of(*preset.color));
    for (const auto& [name, value] : preset.values)
        parts.push_back(fmt::format("{} = {}", name, candela::text_of(value)));
    return fmt::format("{}", fmt::join(parts, ", "));
}

/// Each source once, in the order of the presets.
std::vector<std::string> sources_of(const std::vector<candela::Preset>& presets) {
    std::vector<std::string> sources;
    for (const candela::Preset& p : presets) {
        if (!p.source.empty() && std::ranges::find(sources, p.source) == sources.end())
            sources.push_back(p.source);
    }
    return sources;
}

/// `id`: as commands call it.
void print(const candela::PluginFile& file, const std::string& id) {
    constexpr std::size_t k_names = 20;
    const candela::Manifest& m = file.manifest;
    const auto line = [](const std::string& text) { return candela::printable(text); };
    std::cout << wrapped(line(fmt::format("{} ({}), version {}", m.title, id, m.version)), 0, 0) << '\n'
              << wrapped(line(m.summary), 0, 0) << '\n';
    if (!m.formula.empty()) std::cout << "\nFormula\n" << indented(m.formula);
    if (!m.reference.empty()) std::cout << "\nReference\n" << indented(m.reference);
    if (!m.author.empty()) std::cout << "\nAuthor\n" << indented(m.author);
    if (!m.license.empty()) std::cout << "\nLicense\n" << indented(m.license);
    if (!m.parameters.empty()) std::cout << "\nParameters\n";
    for (const candela::Parameter& p : *file.schema) {
        std::cout << row(line(p.name), line(what_is_allowed(p)), k_names)
                  << row("", line(p.meaning), k_names);
    }
    for (const candela::Relation& r : m.relations)
        std::cout << "  " << wrapped(line(candela::text_of(r)), 2, 4) << '\n';
    if (!m.presets.empty()) std::cout << "\nPresets\n";
    for (const candela::Preset& p : m.presets) std::cout << row(line(p.name), line(text_of(p)), k_names);
    for (const std::string& source : sources_of(m.presets))
        std::cout << "  " << wrapped(line("from " + source), 2, 4) << '\n';
    if (!m.formats.empty()) std::cout << "\nFormats\n";
    for (const candela::ManifestFormat& f : m.formats)
        std::cout << row('.' + line(f.extension), line(f.title), 7);
    if (!m.properties.empty()) std::cout << "\nProperties\n";
    for (const auto& [name, value] : m.properties) {
        std::cout << "  " << wrapped(line(value == "true" ? name : fmt::format("{}: {}", name, value)), 2, 4)
                  << '\n';
    }
    std::cout << "\nLibrary\n  " << file.library.string() << '\n';
}

}  // namespace

int run_describe(const std::vector<std::string>& arguments) {
    CommandLine line("candela describe KIND/NAME|FILE.kernel [options]",
                     "Explain a plugin or a kernel file: its formula, its paper, its parameters.");
    line.positional("plugin", 1);
    line.options()("json", "print the manifest as JSON");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("plugin"))
        throw Error(ErrorCategory::bad_request, "candela describe needs a plugin, such as reflection/phong");
    candela::Registry registry = registry_from(line);
    const std::string name = line.all("plugin").front();
    const candela::PluginFile& file = plugin_called(name, registry);
    if (line.has("json")) {
        std::cout << printable_json(candela::to_json(file.manifest));
    } else {
        print(file, candela::plugin_id(file.manifest.kind,
                                       candela::is_kernel_file(name) ? name : file.manifest.name));
    }
    return 0;
}
