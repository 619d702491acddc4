#include "cli/subcommands.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <iostream>

#include "console/exit_code.h"

import candela.util;

int run_subverb(const std::string& verb, std::span<const Verb> verbs,
                const std::vector<std::string>& arguments) {
    if (complete_verb(arguments, verbs)) return 0;
    std::vector<std::string> names;
    for (const Verb& each : verbs) names.emplace_back(each.name);
    if (arguments.empty() || arguments.front() == "--help" || arguments.front() == "-h") {
        std::string text = fmt::format("Usage: candela {} {} [arguments]\n\n", verb, fmt::join(names, "|"));
        for (const Verb& each : verbs) text += fmt::format("  {:<8} {}\n", each.name, each.summary);
        (arguments.empty() ? std::cerr : std::cout) << text;
        return arguments.empty() ? static_cast<int>(ExitCode::usage) : 0;
    }
    for (const Verb& each : verbs) {
        if (arguments.front() == each.name) return each.run({arguments.begin() + 1, arguments.end()});
    }
    const std::string meant = candela::suggestion(arguments.front(), names);
    throw candela::Error(
        candela::ErrorCategory::bad_request,
        fmt::format("unknown verb '{} {}'; {}", verb, arguments.front(),
                    meant.empty() ? fmt::format("candela {} --help shows all", verb) : meant));
}
