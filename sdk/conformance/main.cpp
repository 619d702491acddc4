// candela-conformance PLUGIN.so… [--json] [--check TEXT] [--set NAME=VALUE] [--time-limit SECONDS]
//                     [--in-process] [--list KIND] [--answer FILE]
//
// The conformance kit: every group of checks in its own process. Run by `candela plugin test` and by the
// tests that candela_add_plugin() creates.
#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "answer.h"
#include "answer_process.h"
#include "groups.h"
#include "outcome.h"
#include "subject.h"

import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;

namespace {

/// The command's codes; the command runs this program.
enum class ExitCode : int { ok = 0, failure = 1, usage = 2, verification_failed = 4 };

// A plugin that never returns would use up its time in every check.
constexpr int k_most_timed_out = 2;

struct Options {
    std::vector<std::string> files;
    std::string only;
    GivenValues given;
    double time_limit = 45;
    bool in_process = false;
    bool json = false;
    std::string answer;  // a file
};

struct Report {
    fs::path library;
    std::string id;
    std::vector<Outcome> outcomes;
};

/// The kind according to the file's name: the manifest may be at fault.
std::string kind_of(const fs::path& library) {
    const std::string name = library.filename().string();
    const std::string kind = name.substr(0, name.find('-'));
    return candela::plugin_kind_named(kind) ? kind : "all";
}

/// Prints the result of a check at once, because the next one may take long.
void print(const Outcome& outcome) {
    std::cout << fmt::format("  {:<9} {}\n", name_of(outcome.verdict), outcome.group);
    for (const std::string& message : outcome.messages) std::cout << fmt::format("            {}\n", message);
    std::cout.flush();
}

Report test(const fs::path& library, const Options& options) {
    Report report{.library = library, .id = library.stem().string(), .outcomes = {}};
    std::string blocked;
    int timed_out = 0;
    const auto add = [&](Outcome outcome) {
        if (!options.json) print(outcome);
        report.outcomes.push_back(std::move(outcome));
    };
    for (const std::string& group : groups_for(kind_of(library))) {
        const bool is_handshake = group.starts_with("handshake");
        if (!options.only.empty() && !is_handshake && group.find(options.only) == std::string::npos) continue;
        if (!blocked.empty()) {
            add({group, Verdict::skipped, {blocked}, 0});
            continue;
        }
        const auto run = [&](Findings& findings) {
            set_subject(library, options.given);
            run_group(group, findings);
        };
        add(options.in_process ? run_here(group, run) : run_in_child(group, options.time_limit, run));
        const Verdict verdict = report.outcomes.back().verdict;
        if (is_handshake && !is_acceptable(verdict)) blocked = "it cannot be loaded";
        if (verdict == Verdict::timed_out && ++timed_out == k_most_timed_out && blocked.empty())
            blocked = fmt::format("{} checks have not finished, so the rest is not run", timed_out);
    }
    return report;
}

Report judge_answer(const fs::path& library, const Options& options) {
    std::ifstream file(options.answer, std::ios::binary);
    const std::string text(std::istreambuf_iterator<char>(file), {});
    if (!file) throw std::runtime_error(fmt::format("'{}' cannot be read", options.answer));
    const auto run = [&](Findings& findings) {
        set_subject(library, options.given);
        set_answer(text);
        run_group(k_answer_group, findings);
    };
    Report report{.library = library,
                  .id = library.stem().string(),
                  .outcomes = {run_in_child(k_answer_group, options.time_limit, run)}};
    if (!options.json) print(report.outcomes.front());
    return report;
}

bool conforms(const Report& report) {
    for (const Outcome& outcome : report.outcomes) {
        if (!is_acceptable(outcome.verdict)) return false;
    }
    return true;
}

void print_summary(const Report& report) {
    std::size_t counts[6] = {};
    for (const Outcome& outcome : report.outcomes) ++counts[static_cast<int>(outcome.verdict)];
    std::string summary;
    for (int i = 0; i < 6; ++i) {
        if (counts[i] > 0)
            summary += fmt::format("{}{} {}", summary.empty() ? "" : ", ", counts[i],
                                   name_of(static_cast<Verdict>(i)));
    }
    std::cout << fmt::format("{}: {}\n", conforms(report) ? "It conforms" : "It does not conform", summary);
}

nlohmann::ordered_json json_of(const Report& report) {
    nlohmann::ordered_json outcomes = nlohmann::ordered_json::array();
    for (const Outcome& outcome : report.outcomes) {
        outcomes.push_back({{"check", outcome.group},
                            {"outcome", name_of(outcome.verdict)},
                            {"messages", outcome.messages},
                            {"seconds", outcome.seconds}});
    }
    return {{"library", report.library.string()},
            {"conforms", conforms(report)},
            {"checks", std::move(outcomes)}};
}

/// "did you mean 'energy-bounded'?  ", from the words with which checks' names begin.
std::string suggested_check(const std::string& name, const std::string& kind) {
    std::vector<std::string> words;
    for (const std::string& group : groups_for(kind)) {
        words.push_back(group.substr(0, group.find_first_of(":,")));
        const std::string first = words.back().substr(0, words.back().find_first_of(" -"));
        if (first != words.back()) words.push_back(first);
    }
    const std::string meant = candela::suggestion(name, words);
    return meant.empty() ? meant : meant + "  ";
}

/// A plugin on which no check was run must not pass.
std::string problem_with_filter(const Options& options) {
    if (options.only.empty()) return {};
    for (const std::string& file : options.files) {
        if (!fs::is_regular_file(file)) continue;  // reported when it is its turn
        const std::string kind = kind_of(file);
        if (std::ranges::any_of(groups_for(kind), [&](const std::string& group) {
                return group.find(options.only) != std::string::npos;
            }))
            continue;
        return fmt::format("no check of '{}' has '{}' in its name; {}--list {} shows them", file,
                           options.only, suggested_check(options.only, kind), kind);
    }
    return {};
}

int usage(const std::string& message) {
    std::cerr << "candela-conformance: error: " << message << '\n';
    return static_cast<int>(ExitCode::usage);
}

int run(int argc, char** argv) {
    Options options;
    std::vector<std::string> settings;
    po::options_description visible;
    visible.add_options()("help,h", "show this help")("json", "print JSON")(
        "check", po::value<std::string>(&options.only)->value_name("TEXT"),
        "only the checks whose name contains TEXT")(
        "set", po::value<std::vector<std::string>>(&settings)->value_name("NAME=VALUE")->composing(),
        "a parameter's value for all checks, such as a file that the plugin needs (repeatable)")(
        "answer", po::value<std::string>(&options.answer)->value_name("FILE"),
        "judge another kernel text for the plugin instead, like candela exercise grade")(
        "in-process", "run all checks in this process, without a time limit: for a debugger")(
        "time-limit", po::value<double>(&options.time_limit)->value_name("SECONDS")->default_value(45, "45"),
        "for each check")("list", po::value<std::string>()->value_name("KIND"),
                          "list the checks for a kind of plugin");
    po::options_description all;
    all.add(visible).add_options()("file", po::value<std::vector<std::string>>(&options.files));
    po::positional_options_description positional;
    positional.add("file", -1);
    po::variables_map values;
    po::store(po::command_line_parser(argc, argv).options(all).positional(positional).run(), values);
    po::notify(values);
    if (values.contains("help")) {
        std::cout
            << "Usage: candela plugin test PLUGIN.so|FILE.kernel... [options]\n\nChecks everything about "
               "plugins, and about kernel files as models, that a host relies on, each check in its own "
               "process.\n\n"
            << visible;
        return 0;
    }
    if (values.contains("list")) {
        const std::string kind = values["list"].as<std::string>();
        if (!candela::plugin_kind_named(kind)) {
            std::vector<std::string> kinds;
            for (const candela::PluginKind k : candela::k_plugin_kinds)
                kinds.emplace_back(candela::name_of(k));
            const std::string meant = candela::suggestion(kind, kinds);
            return usage(fmt::format("unknown plugin kind '{}'; {}(kinds: {})", kind,
                                     meant.empty() ? "" : meant + ' ', fmt::join(kinds, ", ")));
        }
        for (const std::string& group : groups_for(kind)) std::cout << group << '\n';
        return 0;
    }
    if (options.files.empty()) return usage("name at least one plugin, such as build/reflection-cel.so");
    constexpr double k_longest_limit = 86'400;
    if (!(options.time_limit > 0 && options.time_limit <= k_longest_limit))
        return usage(fmt::format("--time-limit is {}; it must be more than 0 and at most {} seconds",
                                 options.time_limit, k_longest_limit));
    options.json = values.contains("json");
    options.in_process = values.contains("in-process");
    if (options.in_process && options.files.size() > 1)
        return usage("--in-process takes one plugin: it could not tell several apart");
    for (const std::string& setting : settings) {
        const std::size_t equals = setting.find('=');
        if (equals == 0 || equals == std::string::npos)
            return usage(fmt::format("--set takes NAME=VALUE, such as file=lamp.ies, not '{}'", setting));
        options.given[setting.substr(0, equals)] = setting.substr(equals + 1);
    }

    if (const std::string problem = problem_with_filter(options); !problem.empty()) return usage(problem);
    bool all_conform = true;
    nlohmann::ordered_json reports = nlohmann::ordered_json::array();
    for (const std::string& file : options.files) {
        if (!fs::is_regular_file(file)) {
            std::cerr << fmt::format("candela-conformance: error: there is no file '{}'\n", file);
            return static_cast<int>(ExitCode::failure);
        }
        const fs::path library = fs::absolute(file);
        if (!options.json) std::cout << library.string() << '\n' << std::flush;
        const Report report =
            options.answer.empty() ? test(library, options) : judge_answer(library, options);
        all_conform = all_conform && conforms(report);
        if (options.json) {
            reports.push_back(json_of(report));
        } else {
            print_summary(report);
        }
    }
    if (options.json)
        std::cout << reports.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) << '\n';
    return static_cast<int>(all_conform ? ExitCode::ok : ExitCode::verification_failed);
}

}  // namespace

int main(int argc, char** argv) {
    // Such a process has no other task.
    if (argc == 3 && std::string_view(argv[1]) == k_compute_option) compute_answer(argv[2]);
    try {
        return run(argc, argv);
    } catch (const po::error& problem) {
        return usage(problem.what());
    } catch (const std::exception& problem) {
        std::cerr << "candela-conformance: error: " << problem.what() << '\n';
        return static_cast<int>(ExitCode::failure);
    }
}
