// candela plugin new|test|doctor: for those who write plugins.
#include "plugin.h"

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "helper.h"
#include "verbs.h"

using candela::Error;
using candela::ExitCode;

int run_plugin_test(const std::vector<std::string>& arguments) {
    become_helper("candela-conformance", arguments, "the conformance kit",
                  "package candela-dev, or a build with tests");
}

namespace {

constexpr Verb k_plugin_verbs[] = {
    {"new", "make a project for a plugin of yours", run_plugin_new},
    {"test", "check a plugin for all that a host relies on", run_plugin_test},
    {"doctor", "say what is found where, and what is refused", run_plugin_doctor},
};

}  // namespace

int run_plugin(const std::vector<std::string>& arguments) {
    std::vector<std::string> names;
    for (const Verb& verb : k_plugin_verbs) names.emplace_back(verb.name);
    if (arguments.empty() || arguments.front() == "--help" || arguments.front() == "-h") {
        std::string text = "Usage: candela plugin new|test|doctor [arguments]\n\n";
        for (const Verb& verb : k_plugin_verbs) text += fmt::format("  {:<8} {}\n", verb.name, verb.summary);
        (arguments.empty() ? std::cerr : std::cout) << text;
        return arguments.empty() ? static_cast<int>(ExitCode::usage) : 0;
    }
    for (const Verb& verb : k_plugin_verbs) {
        if (arguments.front() == verb.name) return verb.run({arguments.begin() + 1, arguments.end()});
    }
    const auto near = candela::closest(arguments.front(), names);
    throw Error(ExitCode::usage, fmt::format("unknown verb 'plugin {}'; {}", arguments.front(),
                                             near ? fmt::format("did you mean '{}'?", *near)
                                                  : "candela plugin --help shows all"));
}
