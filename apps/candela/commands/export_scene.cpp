#include "commands/export_scene.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string>
#include <utility>
#include <vector>

#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "console/reporting.h"
#include "files/output_folder.h"

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

void add_models_option(CommandLine& line) {
    line.options()("models", po::value<std::string>()->value_name("NAMES"),
                   "more shading and reflection models to switch to: comma-separated names, ids such as "
                   "shading/flat, or all");
}

void add_approximate_option(CommandLine& line) {
    line.options()(
        "approximate",
        "accept approximations by a target, such as a renderer with models of its own; each approximation "
        "is reported");
}

std::optional<SceneToExport> scene_to_export(const CommandLine& line, candela::Registry& registry,
                                             candela::Diagnostics& diagnostics) {
    auto draft = candela::draft_scene(scene_request_from(line, registry), registry, diagnostics);
    auto compiled = draft ? compile_scene(*draft, registry, diagnostics) : std::nullopt;
    if (!compiled) return std::nullopt;
    const std::vector<std::string> files = line.all("scene");
    std::vector<fs::path> inputs = candela::input_files(*draft);
    for (fs::path& kernel : registry.kernel_files()) inputs.push_back(std::move(kernel));
    return SceneToExport{
        .title = files.empty() ? "The default scene" : fs::path(files.front()).stem().string(),
        .scene = std::move(draft->scene),
        .compiled = std::move(*compiled),
        .inputs = std::move(inputs)};
}

candela::SceneExport export_for(const LoadedTarget& target, const SceneToExport& scene,
                                const CommandLine& line, candela::Registry& registry) {
    candela::ExportRequest request{.title = scene.title, .abilities = target.abilities(), .leaves_out = true};
    if (line.has("models")) {
        request.extra_models = words_of(line.get<std::string>("models"));
        std::erase(request.extra_models, "");
    }
    request.with_model = [&](candela::PluginKind kind, const std::string& name) {
        candela::SceneRequest again = scene_request_from(line, registry);
        // The questions have been answered already.
        again.ask = nullptr;
        again.use_defaults = true;
        const bool is_shading = kind == candela::PluginKind::shading;
        (is_shading ? again.shading : again.reflection) = {name, "--models"};
        candela::Diagnostics ignored;
        return candela::read_scene(again, registry, ignored);
    };
    try {
        return {scene.scene, request, registry};
    } catch (const Error& problem) {
        if (problem.category() != ErrorCategory::bad_request) throw;
        throw Error(problem.category(), fmt::format("--models: {}", problem.what()), problem.help());
    }
}

candela::ExportedProgram program_for(const LoadedTarget& target, const candela::SceneExport& exported,
                                     const CommandLine& line) {
    candela::ExportedProgram program = target.program_of(exported.scene());
    program.approximations.insert(program.approximations.begin(), exported.left_out().begin(),
                                  exported.left_out().end());
    if (!program.approximations.empty() && !line.has("approximate"))
        throw Error(ErrorCategory::failure,
                    fmt::format("target/{} can only approximate this scene; --approximate accepts this: {}",
                                target.name(), fmt::join(program.approximations, "; ")));
    for (const std::string& sentence : program.approximations)
        warn(fmt::format("target/{}: {}", target.name(), sentence));
    return program;
}

std::vector<fs::path> names_of(const std::vector<candela::ExportedFile>& files) {
    std::vector<fs::path> names;
    for (const candela::ExportedFile& file : files) names.emplace_back(file.name);
    return names;
}

void require_no_input_in(const fs::path& folder, const std::vector<fs::path>& names,
                         const SceneToExport& scene, const std::string& option) {
    for (const fs::path& name : names)
        require_no_input((folder / name).string(), scene.inputs, "the files that the scene is made from",
                         fmt::format("choose another folder with --{}", option));
}

void write_program(const std::vector<candela::ExportedFile>& files, const fs::path& directory) {
    OutputFolder folder(directory);
    for (const candela::ExportedFile& file : files) folder.write(file.name, file.content);
    folder.finish();
}
