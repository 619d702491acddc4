// candela plugin new|test|doctor: for those who write plugins.
#include "plugin.h"

#include <fmt/format.h>

#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "exit_code.h"
#include "helper.h"
#include "verbs.h"

import candela.text;

using candela::Error;
using candela::ErrorCategory;

int run_plugin_test(const std::vector<std::string>& arguments) {
    become_helper(
        helper("candela-conformance", "the conformance kit", "package candela-dev, or a build with tests"),
        arguments);
}

namespace {

constexpr Verb k_plugin_verbs[] = {
    {"new", "create a plugin project", run_plugin_new},
    {"test", "run the conformance kit on a plugin", run_plugin_test},
    {"doctor", "show which plugins are found where, and which are refused and why", run_plugin_doctor},
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
    const std::string meant = candela::suggestion(arguments.front(), names);
    throw Error(ErrorCategory::bad_request,
                fmt::format("unknown verb 'plugin {}'; {}", arguments.front(),
                            meant.empty() ? "candela plugin --help shows all" : meant));
}
