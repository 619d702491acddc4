// candela plugin doctor: what is found where, and what is refused.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "diagnostics_text.h"
#include "exit_code.h"
#include "plugin.h"

import candela.library;
import candela.text;

namespace fs = std::filesystem;

namespace {

/// Why a library cannot be loaded; empty if it can. In a child: what a library does when it is loaded may end
/// the process.
std::string loading_problem(const candela::PluginFile& file) {
    int ends[2];
    if (::pipe2(ends, O_CLOEXEC) != 0) return std::strerror(errno);
    const pid_t child = ::fork();
    if (child < 0) return std::strerror(errno);
    if (child == 0) {
        std::string problem;
        try {
            candela::load_plugin(file.library, &file.manifest);
        } catch (const std::exception& refusal) {
            problem = refusal.what();
        }
        const bool told =
            ::write(ends[1], problem.data(), problem.size()) == static_cast<ssize_t>(problem.size());
        ::_exit(told ? 0 : 1);
    }
    ::close(ends[1]);
    std::string problem;
    std::array<char, 4096> buffer{};
    for (ssize_t count = 0; (count = ::read(ends[0], buffer.data(), buffer.size())) > 0;)
        problem.append(buffer.data(), static_cast<std::size_t>(count));
    ::close(ends[0]);
    int status = 0;
    ::waitpid(child, &status, 0);
    if (WIFSIGNALED(status))
        return fmt::format("loading it ends the process with signal {}", ::strsignal(WTERMSIG(status)));
    if (WEXITSTATUS(status) != 0)
        return fmt::format("loading it ends the process with exit code {}", WEXITSTATUS(status));
    return problem;
}

/// "refused: …" without the path, which is said already: absolute if the library was to be loaded, or as the
/// search path has it.
std::string short_reason(const std::string& reason, const fs::path& library) {
    for (const fs::path& path : {library, fs::absolute(library).lexically_normal()}) {
        const std::string begin = fmt::format("plugin '{}' is refused: ", path.string());
        if (reason.starts_with(begin)) return reason.substr(begin.size());
    }
    return reason;
}

}  // namespace

int run_plugin_doctor(const std::vector<std::string>& arguments) {
    CommandLine line("candela plugin doctor [options]",
                     "Looks at every folder on the search path and loads every plugin there; shows which are "
                     "used, which are\n"
                     "hidden by another of the same name, and which are refused and why.");
    add_plugin_options(line);
    if (!line.parse(arguments)) return 0;
    bool all_well = true;
    candela::Registry registry = registry_from(line);
    for (const fs::path& folder : registry.search_path()) {
        const bool exists = fs::is_directory(folder);
        std::cout << folder.string() << (exists ? "\n" : "  (not there)\n");
        const auto say = [](const fs::path& library, const std::string& what) {
            std::cout << fmt::format("  {:<30} {}\n", candela::printable(library.filename().string()),
                                     candela::printable(what));
        };
        candela::Registry here({folder}, registry.trust());
        for (const candela::PluginFile* file : here.list()) {
            const candela::Manifest& manifest = file->manifest;
            // What a render would use.
            const candela::PluginFile* const used = registry.find(manifest.kind, manifest.name);
            if (const std::string problem = loading_problem(*file); !problem.empty()) {
                say(file->library, "refused: " + short_reason(problem, file->library));
                all_well = false;
            } else if (used == nullptr) {
                say(file->library, "not used: the one that --plugin-dir names is refused");
            } else if (used->library != file->library) {
                say(file->library, "hidden by " + used->library.string());
            } else {
                say(file->library, fmt::format("in use: {} {}", manifest.id(), manifest.version));
            }
        }
        for (const candela::Refusal& refusal : here.refusals()) {
            say(refusal.file,
                "refused: " + short_reason(full_message(refusal.reason, refusal.help), refusal.file));
            all_well = false;
        }
    }
    std::cout << (all_well ? "All is well.\n" : "Some plugins cannot be used.\n");
    return static_cast<int>(all_well ? ExitCode::ok : ExitCode::failure);
}
