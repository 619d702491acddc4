// candela describe: a plugin, as its manifest tells it.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <optional>
#include <string>

#include "command_line.h"
#include "verbs.h"

using candela::Error;
using candela::ErrorCategory;

namespace {

/// "reflection/phong"; a name alone where only one kind has it.
const candela::PluginFile& plugin_called(const std::string& id, candela::Registry& registry) {
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
    throw Error(ErrorCategory::bad_request, fmt::format("no plugin is called '{}'; {}", id,
                                                        meant.empty() ? "candela list shows all" : meant));
}

std::string indented(const std::string& text) {
    std::string result = "  ";
    for (const char c : text) {
        result += c;
        if (c == '\n') result += "  ";
    }
    return result;
}

void print(const candela::PluginFile& file) {
    const candela::Manifest& m = file.manifest;
    std::cout << fmt::format("{} ({}), version {}\n{}\n", m.title, m.id(), m.version, m.summary);
    if (!m.formula.empty()) std::cout << "\nFormula\n" << indented(m.formula) << '\n';
    if (!m.reference.empty()) std::cout << "\nReference\n" << indented(m.reference) << '\n';
    if (!m.parameters.empty()) std::cout << "\nParameters\n";
    for (const candela::Parameter& p : m.parameters) {
        const std::string default_value =
            p.default_value ? "default " + candela::text_of(*p.default_value) : std::string("required");
        std::cout << fmt::format("  {:<20} {}; {}{}{}\n", p.name, candela::constraint_text(p), default_value,
                                 p.unit.empty() ? "" : " " + p.unit, "");
        std::cout << fmt::format("  {:<20} {}\n", "", p.meaning);
    }
    for (const candela::Relation& r : m.relations) std::cout << fmt::format("  {}\n", candela::text_of(r));
    if (!m.formats.empty()) std::cout << "\nFormats\n";
    for (const candela::ManifestFormat& f : m.formats)
        std::cout << fmt::format("  .{:<6} {}\n", f.extension, f.title);
    if (!m.properties.empty()) std::cout << "\nProperties\n";
    for (const auto& [name, value] : m.properties) {
        std::cout << (value == "true" ? fmt::format("  {}\n", name) : fmt::format("  {}: {}\n", name, value));
    }
    std::cout << "\nLibrary\n  " << file.library.string() << '\n';
}

}  // namespace

int run_describe(const std::vector<std::string>& arguments) {
    CommandLine line("candela describe KIND/NAME [options]",
                     "Explains a plugin: its formula, its paper, its parameters.");
    line.positional("plugin", 1);
    line.options()("json", "as JSON");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("plugin"))
        throw Error(ErrorCategory::bad_request, "candela describe needs a plugin, such as reflection/phong");
    candela::Registry registry = registry_from(line);
    const candela::PluginFile& file = plugin_called(line.all("plugin").front(), registry);
    if (line.has("json")) {
        std::cout << candela::to_json(file.manifest);
    } else {
        print(file);
    }
    return 0;
}
