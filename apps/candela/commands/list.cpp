// candela list: lists the installed plugins.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>
#include <optional>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "console/wrapping.h"
#include "json/json.h"

import candela.util;

using candela::Error;
using candela::ErrorCategory;

namespace {

/// "light", and also "lights".
candela::PluginKind kind_from(std::string name) {
    std::vector<std::string> names;
    for (const candela::PluginKind kind : candela::k_plugin_kinds) {
        const std::string singular(candela::name_of(kind));
        if (name == singular || name == singular + "s") return kind;
        names.push_back(singular);
    }
    const std::string meant = candela::suggestion(name, names);
    throw Error(ErrorCategory::bad_request,
                fmt::format("unknown kind of plugin '{}'; {}(kinds: {})", name,
                            meant.empty() ? "" : meant + ' ', fmt::join(names, ", ")));
}

}  // namespace

int run_list(const std::vector<std::string>& arguments) {
    CommandLine line("candela list [KIND] [options]",
                     "List the installed plugins, or only those of one kind (light, reflection, shading, "
                     "shape, image or target).");
    line.positional("kind", 1);
    line.options()("json", "print everything the plugins declare, as JSON");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;

    std::optional<candela::PluginKind> wanted;
    if (line.has("kind")) wanted = kind_from(line.all("kind").front());
    candela::Registry registry = registry_from(line);
    std::vector<candela::Manifest> manifests;
    for (const candela::PluginFile* file : registry.list()) {
        if (!wanted || file->manifest.kind == *wanted) manifests.push_back(file->manifest);
    }
    report_refusals(registry);
    if (line.has("json")) {
        std::cout << printable_json(candela::to_json(manifests));
        return 0;
    }
    std::optional<candela::PluginKind> heading;
    for (const candela::Manifest& manifest : manifests) {
        if (heading != manifest.kind)
            std::cout << fmt::format("{}{}\n", heading ? "\n" : "", candela::name_of(manifest.kind));
        heading = manifest.kind;
        std::cout << row(candela::printable(manifest.name), candela::printable(manifest.summary), 14);
    }
    if (manifests.empty()) std::cerr << "candela: no plugins found\n";
    return 0;
}
