// candela-manifest PLUGIN.so OUTPUT.json [--author=NAME] [--license=SPDX]
//                  [--scalar-loops=warning|error --kernel=FILE OBJECT...]
//
// Writes a plugin's manifest from its own descriptor. Run by candela_add_plugin(). Next to each object file
// are clang's remarks on its loops; those that are scalar are reported first, as warnings or errors.
#include <fmt/format.h>
#include <sys/types.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "loops.h"
#include "sandbox/guarded_child.h"

import candela.plugins;
import candela.util;

namespace {

struct Options {
    std::string plugin, output, author, license, scalar_loops, kernel;
    std::vector<std::filesystem::path> objects;

    /// Returns whether the arguments are valid.
    bool read(int argc, char** argv) {
        if (argc < 3) return false;
        plugin = argv[1];
        output = argv[2];
        const std::array<std::pair<std::string_view, std::string*>, 4> named{
            {{"--author=", &author},
             {"--license=", &license},
             {"--scalar-loops=", &scalar_loops},
             {"--kernel=", &kernel}}};
        for (int i = 3; i < argc; ++i) {
            const std::string_view word = argv[i];
            const auto option =
                std::ranges::find_if(named, [&](const auto& o) { return word.starts_with(o.first); });
            if (option != named.end()) {
                *option->second = word.substr(option->first.size());
            } else if (word.starts_with("--")) {
                return false;
            } else {
                objects.emplace_back(word);
            }
        }
        return scalar_loops.empty() || scalar_loops == "warning" || scalar_loops == "error";
    }
};

/// Reports the scalar loops; returns whether that is an error.
bool judge_loops(const Options& options) {
    bool is_error = false;
    for (std::filesystem::path record : options.objects) {
        record.replace_extension(".opt.yaml");
        if (!std::filesystem::exists(record)) {
            std::fprintf(stderr, "%s is missing: whether loops over points are vectorized is not known\n",
                         record.c_str());
        }
        for (const ScalarLoop& loop : scalar_loops(record, options.kernel)) {
            std::fprintf(stderr,
                         "%s: %s: this keeps the loop over points from being vectorized, so that the plugin "
                         "is several times slower: %s\n",
                         loop.place.c_str(), options.scalar_loops.c_str(), loop.why.c_str());
            is_error = options.scalar_loops == "error";
        }
    }
    return is_error;
}

/// On the main thread of a process that runs nothing else.
void write_manifest(const Options& options) {
    const candela::PluginDescriptor& descriptor = candela::load_plugin(options.plugin, nullptr);
    candela::Manifest manifest = candela::manifest_of(descriptor, candela::host_abi());
    candela::require_name(options.author, "author");
    candela::require_name(options.license, "license");
    manifest.author = options.author;
    manifest.license = options.license;
    const std::string json = candela::to_json(manifest);
    const std::filesystem::path temporary = options.output + ".new";
    {
        std::ofstream out(temporary, std::ios::binary);
        if (!(out << json) || !out.flush()) throw std::runtime_error("cannot write " + temporary.string());
    }
    std::filesystem::rename(temporary, options.output);
}

constexpr std::string_view k_done = "done";

void say_in(int report, std::string_view text) {
    if (::write(report, text.data(), text.size()) != static_cast<ssize_t>(text.size())) ::_exit(1);
}

/// Why the manifest could not be written; empty if it was. Code that runs when the plugin is
/// loaded may end the process, or block it forever.
std::string problem_with(const Options& options) {
    constexpr double k_longest = 120;  // seconds, on a machine that is busy building
    const GuardedEnd end = run_guarded(k_longest, [&](int report) {
        try {
            write_manifest(options);
            say_in(report, k_done);
        } catch (const std::exception& problem) {
            say_in(report, problem.what());
        } catch (...) {
            say_in(report, "the plugin threw an object that is not a std::exception");
        }
    });
    if (end.report == k_done) return {};
    if (!end.report.empty()) return end.report;
    return fmt::format("loading '{}' {}", options.plugin, unexpected_end_of(end, k_longest));
}

}  // namespace

int main(int argc, char** argv) {
    try {
        Options options;
        if (!options.read(argc, argv)) {
            std::fputs(
                "usage: candela-manifest PLUGIN.so OUTPUT.json [--author=NAME] [--license=SPDX]\n"
                "                        [--scalar-loops=warning|error --kernel=FILE OBJECT...]\n",
                stderr);
            return 2;
        }
        if (!options.scalar_loops.empty() && judge_loops(options)) return 1;
        if (const std::string problem = problem_with(options); !problem.empty())
            throw std::runtime_error(problem);
        return 0;
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "candela-manifest: %s\n", problem.what());
        return 1;
    }
}
