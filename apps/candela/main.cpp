// candela VERB …: composes lights, shapes, shading and reflection models by name.
//
// Linked into two programs: candela has what most pictures need, and candela-verbs has all of the command, so
// that the first picture after a checkout does not wait for the rest to be built. Users only see candela,
// which becomes candela-verbs when necessary (elsewhere.cpp).
#include <fmt/format.h>
#include <malloc.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <iostream>
#include <span>
#include <string>
#include <vector>

#include "cli/commands.h"
#include "cli/completion.h"
#include "cli/elsewhere.h"
#include "cli/manual.h"
#include "cli/signals.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/wrapping.h"
#include "jobs/heartbeat.h"
#include "programs/sibling_program.h"

import candela.util;

namespace {

using candela::Error;
using candela::ErrorCategory;

constexpr std::array k_verbs = {
    Verb{"new", "write a starter scene", run_new},
    Verb{"import", "write a scene that shows a model from another program", run_import},
    Verb{"render", "render a scene to a picture", run_render},
    Verb{"animate", "render an animated scene to frames or a film", run_animate},
    Verb{"submit", "distribute frames or parts of a picture over processes or a cluster", run_submit},
    Verb{"status", "show a job's progress and failures", run_status},
    Verb{"assemble", "put the parts of a picture together", run_assemble},
    Verb{"check", "check a scene and report its errors", run_check},
    Verb{"edit", "write changes into a scene's files", run_edit},
    Verb{"explain", "explain how a pixel gets its colour", run_explain},
    Verb{"generate", "write a program that renders a scene", run_generate},
    Verb{"verify", "verify that generated programs render what Candela renders", run_verify},
    Verb{"view", "show a scene in the browser, updated whenever its files are saved", run_view},
    Verb{"compare", "render a contact sheet that compares models", run_compare},
    Verb{"bench", "time each stage of rendering a scene", run_bench},
    Verb{"diff", "compare two pictures", run_diff},
    Verb{"plot", "plot the lobes of reflection models, or the light emitted by lights", run_plot},
    Verb{"exercise", "create and grade fill-in-the-formula exercises", run_exercise},
    Verb{"list", "list the installed plugins", run_list},
    Verb{"describe", "explain a plugin: formula, paper, parameters", run_describe},
    Verb{"plugin", "create, test and diagnose plugins", run_plugin},
    Verb{"schema", "print the scene file's JSON Schema or reference", run_schema},
};

std::string help() {
    std::string text =
        wrapped("Candela renders scenes whose lights, shapes, shading and reflection models are plugins.", 0,
                0) +
        "\n\nUsage: candela VERB [arguments]\n\nVerbs\n";
    for (const Verb& verb : k_verbs) text += row(verb.name, verb.summary, 10);
    text +=
        "\n  candela VERB --help   the arguments of a verb\n"
        "  candela --version     the version\n\n"
        "Try: candela new               write a starter scene, scene.toml\n"
        "     candela render            render the default scene to candela.png\n";
    return text;
}

/// CANDELA_INSTRUCTION_SET=baseline|avx2|avx512: for measurements and debugging.
void choose_instruction_set() {
    const char* const name = std::getenv("CANDELA_INSTRUCTION_SET");
    if (name == nullptr || *name == '\0') return;
    const auto set = candela::instruction_set_named(name);
    if (!set) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("CANDELA_INSTRUCTION_SET is '{}'; expected baseline, avx2 or avx512", name));
    }
    if (!candela::use_instruction_set(*set)) {
        throw Error(
            ErrorCategory::bad_request,
            fmt::format("CANDELA_INSTRUCTION_SET is '{}', which this processor does not support", name));
    }
}

int run(const std::vector<std::string>& arguments) {
    if (complete_verb(arguments, k_verbs)) return 0;
    if (arguments.empty()) {
        std::cerr << help();
        return static_cast<int>(ExitCode::usage);
    }
    const std::string& name = arguments.front();
    if (name == "--version" || name == "version") {
        std::cout << "candela " CANDELA_VERSION << "\n";
        return 0;
    }
    std::vector<std::string> rest(arguments.begin() + 1, arguments.end());
    if (name == k_task && rest.size() > 1)
        return with_journal(rest.front(), [&] { return run({rest.begin() + 1, rest.end()}); });
    if (name == "--help" || name == "-h" || (name == "help" && rest.empty())) {
        std::cout << help();
        return 0;
    }
    if (name == "--help-as") {
        std::cout << manual_page(k_verbs);
        return 0;
    }
    if (name == "help" && complete_verb(rest, k_verbs)) return 0;
    if (name == "help") return run({rest.front(), "--help"});
    choose_instruction_set();
    std::vector<std::string> names;
    for (const Verb& verb : k_verbs) {
        if (verb.name == name) return verb.run(rest);
        names.emplace_back(verb.name);
    }
    const std::string meant = candela::suggestion(name, names);
    throw Error(ErrorCategory::bad_request, fmt::format("unknown verb '{}'; {}", name,
                                                        meant.empty() ? "candela --help shows all" : meant));
}

/// The arrays of meshes and pictures are allocated and freed one after another. Memory returned to the system
/// in between would come back page by page, cleared: a sixth of the time of exporting a scene as a page.
void keep_freed_memory() {
    ::mallopt(M_MMAP_THRESHOLD, 32 << 20);
    ::mallopt(M_TRIM_THRESHOLD, 64 << 20);
}

}  // namespace

std::span<const Verb> verbs() { return k_verbs; }

bool complete_verb(const std::vector<std::string>& arguments, std::span<const Verb> verbs) {
    if (!is_completing() || arguments.size() > 1) return false;
    std::vector<Completion> names;
    for (const Verb& verb : verbs) names.push_back({verb.name, verb.summary});
    print_completions(arguments.empty() ? "" : arguments.front(), names);
    return true;
}

int main(int argc, char** argv) {
    prepare_for_signals();
    keep_freed_memory();
    return run_and_report([&] {
        const std::vector<std::string> arguments(argv + 1, argv + argc), words = words_to_complete(arguments);
        try {
            return run(words);
        } catch (const Elsewhere&) {
            exec_sibling(all_verbs(), arguments);
        }
    });
}
