// candela plugin new|test|doctor: for plugin authors.
#include "commands/plugin.h"

#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/subcommands.h"
#include "programs/sibling_program.h"

int run_plugin_test(const std::vector<std::string>& arguments) {
    if (is_completing()) {
        print_file_completions(FileKind::any);
        return 0;
    }
    exec_sibling(conformance_kit(), arguments);
}

int run_plugin(const std::vector<std::string>& arguments) {
    static constexpr Verb k_plugin_verbs[] = {
        {"new", "create a plugin project", run_plugin_new},
        {"test", "run the conformance kit on a plugin", run_plugin_test},
        {"doctor", "show which plugins are found, and which are refused and why", run_plugin_doctor},
    };
    return run_subverb("plugin", k_plugin_verbs, arguments);
}
