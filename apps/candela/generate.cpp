// candela generate: a scene becomes a program that renders it.
#include <fmt/format.h>

#include <filesystem>
#include <iostream>
#include <string>
#include <vector>

#include "command_line.h"
#include "exit_code.h"
#include "generate/building.h"
#include "generate/exported_scene.h"
#include "generate/target.h"
#include "generating.h"
#include "reporting.h"
#include "terminal.h"
#include "verbs.h"

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

int run_generate(const std::vector<std::string>& arguments) {
    CommandLine line("candela generate [SCENE...] --target cpp|opengl|webgl [options]",
                     "Writes a program that renders a scene, with the formulas of its models as their "
                     "authors wrote them:\n"
                     "  cpp     " +
                         std::string(generate::target_called("cpp").summary) +
                         "\n"
                         "  opengl  " +
                         std::string(generate::target_called("opengl").summary) +
                         "\n"
                         "  webgl   " +
                         std::string(generate::target_called("webgl").summary) +
                         "\n"
                         "`candela verify` shows that its picture is Candela's.");
    line.options()("target,t", po::value<std::string>()->value_name("NAME"),
                   "what to write: cpp, opengl or webgl")(
        "output,o", po::value<std::string>()->value_name("DIR"), "the output folder; default: scene-NAME")(
        "build", "also build it, with CMake")("run",
                                              "build it and run it: a picture, a window, or a browser");
    add_models_option(line);
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    if (!line.has("target"))
        throw Error(ErrorCategory::bad_request, "--target is missing (cpp, opengl or webgl)");
    const generate::Target& target = generate::target_called(line.get<std::string>("target"));
    const fs::path directory =
        line.has("output") ? line.get<std::string>("output") : fmt::format("scene-{}", target.name);

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    const auto scene = scene_to_export(line, registry, diagnostics);
    report(diagnostics);
    if (!scene) return static_cast<int>(exit_code_of(diagnostics));
    const auto files = target.generate(scene->exported, generate_templates(), registry);
    write_program(files, directory);
    for (const generate::GeneratedFile& file : files)
        std::cerr << fmt::format("{}: {}\n", (directory / file.name).string(),
                                 candela::size_text(file.text.size()));
    if (line.has("build") || line.has("run")) generate::build(target, directory);
    return line.has("run") ? generate::show(target, directory) : 0;
}
