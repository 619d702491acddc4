// candela VERB …: composes lights, shapes, shading and reflection models by name.
//
// Compiled twice: candela has the verbs that a picture needs, and candela-verbs has all of them, so that the
// first picture after a checkout does not wait for the others to be built. Users only see candela, which
// becomes candela-verbs when necessary.
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
#include "cli/manual.h"
#include "cli/signals.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/wrapping.h"
#include "jobs/heartbeat.h"
#include "programs/sibling_program.h"

#ifdef CANDELA_ALL_VERBS
constexpr bool k_has_all_verbs = true;
#define ELSEWHERE(run) run
#else
constexpr bool k_has_all_verbs = false;
#define ELSEWHERE(run) nullptr
#endif

import candela.util;

namespace {

using candela::Error;
using candela::ErrorCategory;

constexpr std::array k_verbs = {
    Verb{"new", "write a starter scene", run_new},
    Verb{"import", "write a scene that shows a model from another program", ELSEWHERE(run_import)},
    Verb{"render", "render a scene to a picture", run_render},
    Verb{"animate", "render an animated scene to frames or a film", ELSEWHERE(run_animate)},
    Verb{"submit", "distribute frames or parts of a picture over processes or a cluster",
         ELSEWHERE(run_submit)},
    Verb{"status", "show a job's progress and failures", ELSEWHERE(run_status)},
    Verb{"assemble", "put the parts of a picture together", ELSEWHERE(run_assemble)},
    Verb{"check", "check a scene and report its errors", run_check},
    Verb{"edit", "write changes into a scene's files", ELSEWHERE(run_edit)},
    Verb{"explain", "explain how a pixel gets its colour", ELSEWHERE(run_explain)},
    Verb{"generate", "write a program that renders a scene", ELSEWHERE(run_generate)},
    Verb{"verify", "verify that generated programs render what Candela renders", ELSEWHERE(run_verify)},
    Verb{"view", "show a scene in the browser, updated whenever its files are saved", ELSEWHERE(run_view)},
    Verb{"compare", "render a contact sheet that compares models", ELSEWHERE(run_compare)},
    Verb{"bench", "time each stage of rendering a scene", ELSEWHERE(run_bench)},
    Verb{"diff", "compare two pictures", ELSEWHERE(run_diff)},
    Verb{"plot", "plot the lobes of reflection models, or the light emitted by lights", ELSEWHERE(run_plot)},
    Verb{"exercise", "create and grade fill-in-the-formula exercises", ELSEWHERE(run_exercise)},
    Verb{"list", "list the installed plugins", run_list},
    Verb{"describe", "explain a plugin: formula, paper, parameters", run_describe},
    Verb{"plugin", "create, test and diagnose plugins", ELSEWHERE(run_plugin)},
    Verb{"schema", "print the scene file's JSON Schema or reference", ELSEWHERE(run_schema)},
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

/// Whether a command line is for candela-verbs, and this is not it.
bool is_for_all_verbs(const std::vector<std::string>& arguments) {
    if (k_has_all_verbs || arguments.empty()) return false;
    const bool asks_for_help = arguments.size() > 1 && arguments.front() == "help";
    const std::string& name = arguments[asks_for_help ? 1 : 0];
    return name == k_task || std::ranges::any_of(k_verbs, [&](const Verb& verb) {
               return verb.run == nullptr && verb.name == name;
           });
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
        if (is_for_all_verbs(words)) exec_sibling(all_verbs(), arguments);
        return run(words);
    });
}
