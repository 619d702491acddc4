// candela generate: writes a program that renders a scene.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "commands/export_scene.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "json/json.h"
#include "verify/targets.h"

import candela.api;
import candela.plugins;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// For programs that generate again when an input changes.
void write_inputs(const std::vector<fs::path>& inputs, const std::string& file) {
    require_no_scene_file(file, inputs, "--inputs");
    Json names = Json::array();
    for (const fs::path& input : inputs) names.push_back(fs::absolute(input).string());
    candela::write_text_file(file, json_text(names, 2) + "\n");
}

/// Loads all plugins of a kind in advance, before the scene arrives. Errors are reported only when a plugin
/// is used.
template <class Interface>
void load_all(candela::PluginKind kind, candela::Registry& registry) {
    for (const std::string& name : registry.names(kind)) {
        try {
            registry.create<Interface>(name, registry.parameters(kind, name), candela::ColorEncoding::srgb);
        } catch (const Error&) {
            continue;
        }
    }
}

void load_models(candela::Registry& registry) {
    load_all<candela::Shape>(candela::PluginKind::shape, registry);
    load_all<candela::Light>(candela::PluginKind::light, registry);
    load_all<candela::ShadingModel>(candela::PluginKind::shading, registry);
    load_all<candela::ReflectionModel>(candela::PluginKind::reflection, registry);
}

/// Grows the heap to its final size: the system clears memory page by page on first touch, which takes a
/// third of the time of exporting a scene as a page. Freed blocks stay in the heap (main.cpp).
void touch_memory() {
    constexpr std::size_t k_block = std::size_t{4} << 20;
    std::vector<std::vector<char>> blocks(10);
    for (std::vector<char>& block : blocks) block.resize(k_block);
}

/// Waits for a line; false at the end of input.
bool is_told_to_go_on() {
    std::string line;
    return static_cast<bool>(std::getline(std::cin, line));
}

/// For readers that want the program on standard output, without a file.
void print(const std::vector<candela::ExportedFile>& files, const std::string& target) {
    if (files.size() != 1)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("target/{} writes {} files, but --output - prints only one; give a folder",
                                target, files.size()));
    candela::write_text_file("-", files.front().content);  // unchanged: std::cout would make it printable
}

std::string sizes_of(const std::vector<candela::ExportedFile>& files, const fs::path& directory) {
    std::string text;
    for (const candela::ExportedFile& file : files)
        text += fmt::format("{}: {}\n", (directory / file.name).string(),
                            candela::size_text(file.content.size()));
    return text;
}

}  // namespace

int run_generate(const std::vector<std::string>& arguments) {
    candela::Registry installed(candela::plugin_search_path({}));
    const std::string any = target_names(installed, " or ");
    CommandLine line("candela generate [SCENE...] --target NAME [options]",
                     "Write a program that renders a scene, with the formulas of its models as their authors "
                     "wrote them, or the scene in another program's format:\n" +
                         target_summaries(installed) +
                         "Check with `candela verify` that its picture matches Candela's.");
    const std::string help = "what to write: " + any;
    line.options()("target,t", po::value<std::string>()->value_name("NAME"), help.c_str())(
        "output,o", po::value<std::string>()->value_name("DIR"),
        "the output folder; default: scene-NAME; -: print the file of a target that writes only one")(
        "inputs", po::value<std::string>()->value_name("FILE"),
        "also write a JSON array of the names of all files that the scene is made from")(
        "wait", "load the plugins, then wait for a line on standard input before reading the scene")(
        "build", "also build the program")(
        "run", "build and run the program: it makes a picture or opens a window or a browser");
    add_models_option(line);
    add_approximate_option(line);
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    candela::Registry registry = registry_from(line);
    if (!line.has("target"))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--target is missing ({})", target_names(registry, " or ")));
    const LoadedTarget target(line.get<std::string>("target"), registry);
    const fs::path directory =
        line.has("output") ? line.get<std::string>("output") : fmt::format("scene-{}", target.name());

    require_no_default_link(line, "output", directory);
    const bool is_printed = directory == "-";
    require_no_terminal(directory.string(), "a file for another program");
    if (is_printed && (line.has("build") || line.has("run")))
        throw Error(ErrorCategory::bad_request,
                    "--output - cannot be combined with --build or --run; give a folder");

    if (line.has("wait")) {
        if (line.has("models")) load_models(registry);
        touch_memory();
        if (!is_told_to_go_on()) return 0;
    }
    candela::Diagnostics diagnostics;
    const auto scene = scene_to_export(line, registry, diagnostics);
    report(diagnostics);
    if (!scene) {
        // These may be all that is wrong with it.
        if (line.has("inputs")) write_inputs(registry.kernel_files(), line.get<std::string>("inputs"));
        return static_cast<int>(exit_code_of(diagnostics));
    }
    const auto exported = export_for(target, *scene, line, registry);
    const std::vector<candela::ExportedFile> files = program_for(target, exported, line).files;
    if (is_printed) {
        print(files, target.name());
    } else {
        require_no_input_in(directory, names_of(files), *scene, "output");
        write_program(files, directory);
    }
    if (line.has("inputs")) write_inputs(scene->inputs, line.get<std::string>("inputs"));
    if (!is_printed) say_afterwards([&] { return sizes_of(files, directory); });
    if (line.has("build") || line.has("run")) target.build(directory);
    return line.has("run") ? target.show(directory) : 0;
}
