// candela view: shows a scene in the browser and follows its files.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <iostream>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "commands/export_scene.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "process/process.h"
#include "sandbox/temporary_folder.h"
#include "verify/targets.h"
#include "viewer/arguments.h"
#include "viewer/explainer.h"
#include "viewer/scene_follower.h"
#include "viewer/server.h"

import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

std::uint16_t port_from(const CommandLine& line) {
    if (!line.has("port")) return 0;
    const auto port = line.get<int>("port");
    if (port < 0 || port > 65535)
        throw Error(ErrorCategory::bad_request, fmt::format("--port is {}; expected 0 to 65535", port));
    return static_cast<std::uint16_t>(port);
}

/// Detaches the browser, which must not end together with this process.
void open_browser(const fs::path& page) {
    if (!candela::program_called("xdg-open")) return;
    static_cast<void>(
        candela::run_program({"sh", "-c", "xdg-open \"$1\" >/dev/null 2>&1 &", "sh", page.string()}));
}

}  // namespace

int run_view(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela view SCENE... [options]",
        "Show a scene in the browser, and update it whenever one of its files is saved: the scene, its "
        "includes, meshes, pictures and plugins. Errors are shown next to the last valid picture. Only this "
        "machine can open the page, at the printed address. Ctrl-C ends the program.");
    line.options()("port", po::value<int>()->value_name("N"), "the port of 127.0.0.1; default: a free one")(
        "no-open", "do not open a browser")(
        "target", po::value<std::string>()->value_name("NAME"),
        "the target that makes the page; default: one whose main file is HTML");
    add_models_option(line);
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    for (const std::string& file : line.all("scene")) {
        if (!fs::is_regular_file(file)) {
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("'{}' is not a file; candela view follows files as they are saved", file));
        }
    }
    require_scene_options(line);  // saving a file would not mend them
    candela::Registry registry = registry_from(line);
    const LoadedTarget target =
        line.has("target") ? LoadedTarget(line.get<std::string>("target"), registry) : page_target(registry);
    std::vector<std::string> for_generate = view::without({"--no-open"}, {"--port", "--target"}, arguments);
    if (!line.has("models")) for_generate.insert(for_generate.end(), {"--models", "all"});
    const TemporaryFolder images("candela-view-");
    const TemporaryFolder kernels("candela-view-");  // compiled by explain
    const auto for_render =
        view::without({"--no-open", "--quiet"}, {"--port", "--target", "--models"}, arguments);
    auto for_explain = for_render;
    for_explain.push_back(fmt::format("--keep={}", kernels.path().string()));
    std::vector<std::string> for_keep;
    for (const std::string& folder : line.all("plugin-dir")) for_keep.push_back("--plugin-dir=" + folder);
    if (line.has("allow-untrusted-plugins")) for_keep.emplace_back("--allow-untrusted-plugins");
    // The server reads the signals. Threads started from here on are never interrupted by one.
    std::optional<WithoutInterruption> while_serving(std::in_place);
    std::optional<Explainer> explainer(std::in_place, for_explain);
    std::optional<view::Server> server(
        std::in_place, port_from(line),
        view::Server::Handlers{
            .log = [](const std::string& text) { warn(text); },
            .render =
                [&](const std::vector<view::Change>& changes, std::stop_token unwanted) {
                    return rendered(for_render, changes, images.path() / "reference.png",
                                    std::move(unwanted));
                },
            .explain = [&](const std::vector<view::Change>& changes) { return explainer->explain(changes); },
            .save =
                [&](const std::vector<view::Change>& changes) {
                    const view::Outcome outcome = saved(for_render, changes);
                    if (!outcome.is_success) warn("not saved: " + outcome.content);
                    return outcome;
                },
            .keep =
                [&](const std::vector<view::Change>& changes, const std::string& kernel) {
                    const view::Outcome outcome =
                        kept(for_keep, changes, kernel, images.path() / "kept.kernel");
                    say(outcome.content + '\n');
                    return outcome;
                }});
    // The follower prints on a thread of its own, which must not flush this thread's output.
    std::cerr.tie(nullptr);
    std::optional<SceneFollower> follower(std::in_place,
                                          SceneFollower::Job{.arguments = for_generate,
                                                             .target = target.name(),
                                                             .scenes = line.all("scene"),
                                                             .plugin_folders = registry.search_path()},
                                          [&](view::Publication publication) {
                                              // A scene with errors is not the one shown.
                                              if (publication.problems.empty()) explainer->scene_changed();
                                              server->publish(std::move(publication));
                                          });
    const std::string address = server->address();
    std::cout << address << '\n' << std::flush;  // the reader may be waiting
    if (!line.has("no-open")) open_browser(page_leading_to(address, images.path()));
    server->run();
    while_serving.reset();  // a second signal ends this at once
    // All of them wait for programs that they have started.
    const WithoutDescendants from_now_on;
    follower.reset();
    server.reset();
    explainer.reset();
    return 0;
}
