// candela plugin new|test|doctor: for plugin authors.
#include "commands/plugin.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "candela/kernel_language/model_compiler.h"
#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/subcommands.h"
#include "programs/sibling_program.h"

import candela.api;
import candela.plugins;

int run_plugin_test(const std::vector<std::string>& arguments) {
    if (is_completing()) {
        print_file_completions(FileKind::any);
        return 0;
    }
    // A kernel file is tested as the plugin that it becomes.
    std::vector<std::string> words = arguments;
    for (std::string& word : words) {
        if (word.starts_with("-") || !candela::is_kernel_file(word)) continue;
        const candela::CompiledKernel compiled = candela::kernel_language::compile_kernel_file(word);
        word = (compiled.folder / fmt::format("{}-{}.so", name_of(compiled.kind), compiled.name)).string();
    }
    exec_sibling(conformance_kit(), words);
}

int run_plugin(const std::vector<std::string>& arguments) {
    static constexpr Verb k_plugin_verbs[] = {
        {"new", "create a plugin project", run_plugin_new},
        {"test", "run the conformance kit on a plugin", run_plugin_test},
        {"doctor", "show which plugins are found, and which are refused and why", run_plugin_doctor},
    };
    return run_subverb("plugin", k_plugin_verbs, arguments);
}
