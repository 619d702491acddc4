// candela plugin doctor: shows which plugins are found, and which are refused and why.
#include <fmt/format.h>
#include <unistd.h>

#include <exception>
#include <filesystem>
#include <iostream>
#include <string>
#include <string_view>
#include <vector>

#include "cli/command_line.h"
#include "commands/plugin.h"
#include "console/diagnostics_text.h"
#include "console/exit_code.h"
#include "sandbox/guarded_child.h"

import candela.plugins;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;

namespace {

/// The result of loading a library.
struct Loading {
    std::string problem;  // why it cannot be loaded; empty if it can
    bool leaves_processes = false;
};

/// Loads it in a child process: a library's initialisers may end the process or hang.
Loading loading_of(const candela::PluginFile& file, double longest) {
    constexpr std::string_view k_loaded = "loaded", k_refused = "refused: ";
    const GuardedEnd end = run_guarded(longest, [&](int report) {
        std::string found(k_loaded);
        try {
            candela::load_plugin(file.library, &file.manifest);
        } catch (const candela::Error& refusal) {
            found = std::string(k_refused) + refusal.what();
        } catch (const std::exception& thrown) {
            found = fmt::format("{}loading it throws '{}'", k_refused, thrown.what());
        } catch (...) {
            found = std::string(k_refused) + "loading it throws an object that is not a std::exception";
        }
        // The parent notices a missing report.
        static_cast<void>(::write(report, found.data(), found.size()));
    });
    Loading loading{.problem = {}, .leaves_processes = end.leaves_processes};
    if (end.report.starts_with(k_refused)) {
        loading.problem = end.report.substr(k_refused.size());
    } else if (end.report != k_loaded) {
        loading.problem = "loading it " + unexpected_end_of(end, longest);
    }
    return loading;
}

double longest_from(const CommandLine& line) {
    constexpr double k_usual = 20, k_most = 86'400;  // seconds
    const double longest = line.has("time-limit") ? line.get<double>("time-limit") : k_usual;
    if (longest > 0 && longest <= k_most) return longest;
    throw candela::Error(
        candela::ErrorCategory::bad_request,
        fmt::format("--time-limit is {}; it must be more than 0 and at most {} seconds", longest, k_most));
}

/// "refused: …" without the path, which has been printed already. The reason has it in absolute form if the
/// library was loaded, otherwise as on the search path.
std::string short_reason(const std::string& reason, const fs::path& library) {
    for (const fs::path& path : {library, fs::absolute(library).lexically_normal()}) {
        const std::string begin = fmt::format("plugin '{}' is refused: ", path.string());
        if (reason.starts_with(begin)) return reason.substr(begin.size());
    }
    return reason;
}

}  // namespace

int run_plugin_doctor(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela plugin doctor [options]",
        "Look at every folder on the search path and load every plugin there. Show which plugins are used, "
        "which are hidden by another of the same name, and which are refused and why.");
    add_plugin_options(line);
    line.options()("time-limit", po::value<double>()->value_name("SECONDS"),
                   "the time allowed for loading a plugin; default: 20");
    if (!line.parse(arguments)) return 0;
    const double longest = longest_from(line);
    bool all_well = true;
    candela::Registry registry = registry_from(line);
    for (const fs::path& folder : registry.search_path()) {
        const bool exists = fs::is_directory(folder);
        std::cout << folder.string() << (exists ? "\n" : "  (does not exist)\n");
        const auto say = [](const fs::path& library, const std::string& what) {
            std::cout << fmt::format("  {:<30} {}\n", candela::printable(library.filename().string()),
                                     candela::printable(what));
        };
        candela::Registry here({folder}, registry.trust());
        for (const candela::PluginFile* file : here.list()) {
            const candela::Manifest& manifest = file->manifest;
            // The plugin that a render would use.
            const candela::PluginFile* const used = registry.find(manifest.kind, manifest.name);
            const Loading loading = loading_of(*file, longest);
            if (!loading.problem.empty()) {
                say(file->library, "refused: " + short_reason(loading.problem, file->library));
                all_well = false;
            } else if (used == nullptr) {
                say(file->library, "not used: the one named by --plugin-dir was refused");
            } else if (used->library != file->library) {
                say(file->library, "hidden by " + used->library.string());
            } else {
                say(file->library, fmt::format("in use: {} {}", manifest.id(), manifest.version));
            }
            if (loading.leaves_processes) {
                say(file->library, "starts a process that keeps running every time it is loaded");
                all_well = false;
            }
        }
        for (const candela::Refusal& refusal : here.refusals()) {
            say(refusal.file,
                "refused: " + short_reason(full_message(refusal.reason, refusal.help), refusal.file));
            all_well = false;
        }
    }
    std::cout << (all_well ? "No problems found.\n" : "Some plugins cannot be used.\n");
    return static_cast<int>(all_well ? ExitCode::ok : ExitCode::failure);
}
