// candela schema: describes the scene file for editors and people.
#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "console/reporting.h"

import candela.schema;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

struct Format {
    const char* name;
    std::string (*write)(std::span<const candela::Manifest> installed);
};

constexpr Format k_formats[] = {{"json", candela::scene_json_schema}, {"markdown", candela::scene_reference}};

const Format& format_called(const std::string& name) {
    std::vector<std::string> names;
    for (const Format& format : k_formats) {
        if (format.name == name) return format;
        names.emplace_back(format.name);
    }
    const std::string meant = candela::suggestion(name, names);
    throw Error(ErrorCategory::bad_request, fmt::format("--format is '{}'; {}expected json or markdown", name,
                                                        meant.empty() ? "" : meant + ' '));
}

}  // namespace

int run_schema(const std::vector<std::string>& arguments) {
    CommandLine line("candela schema [options]",
                     "Print the contents of a scene file with all installed plugins: as a JSON Schema, for "
                     "completion and validation in editors, or as a page to read.");
    line.options()("format", po::value<std::string>()->value_name("NAME")->default_value("json"),
                   "the output: json (a JSON Schema, draft-07) or markdown");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;

    const Format& format = format_called(line.get<std::string>("format"));
    candela::Registry registry = registry_from(line);
    std::vector<candela::Manifest> installed;
    for (const candela::PluginFile* file : registry.list()) installed.push_back(file->manifest);
    report_refusals(registry);
    std::cout << format.write(installed);
    return 0;
}
