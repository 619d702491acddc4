// candela verify: generates programs, builds and runs them, and compares their pictures with Candela's.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "commands/export_scene.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/terminal.h"
#include "programs/sibling_program.h"
#include "verify/bias.h"
#include "verify/comparison.h"
#include "verify/edges.h"
#include "verify/report.h"
#include "verify/targets.h"
#include "verify/work_dir.h"

import candela.api;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

std::vector<LoadedTarget> targets_from(const CommandLine& line, candela::Registry& registry) {
    const auto name = line.get<std::string>("target");
    const bool is_all = name == "all";
    if (is_all && line.has("program")) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--program is the folder of one program; name its target with --target {}",
                                target_names(registry, " or ")));
    }
    std::vector<LoadedTarget> chosen;
    if (is_all) {
        for (const std::string& each : registry.names(candela::PluginKind::target)) {
            LoadedTarget target(each, registry);
            // A renderer with models of its own shows only some scenes the way Candela does.
            if (target.can_draw() && !target.abilities().models_without_kernel)
                chosen.push_back(std::move(target));
        }
        return chosen;
    }
    chosen.emplace_back(name, registry);
    if (!chosen.front().can_draw())
        throw Error(ErrorCategory::bad_request,
                    fmt::format("target/{} does not draw a picture, so there is nothing to compare", name));
    return chosen;
}

verify::Limits limits_from(const CommandLine& line) {
    verify::Limits limits;
    limits.maximum = line.get<double>("tolerance");
    if (!(limits.maximum >= 0 && limits.maximum <= 255))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--tolerance is {:g}; expected 0 to 255", limits.maximum));
    return limits;
}

/// Candela's picture, written to reference.png and edges.png, and its known properties.
verify::Expectation expectation_of(candela::RenderScene& scene, double tolerance, const fs::path& folder,
                                   candela::Registry& registry) {
    const candela::ImageSettings& image = scene.image;
    candela::Film film(image.width, image.height, candela::PixelType::byte, candela::display_of(scene));
    candela::render(scene, film, {});
    const auto png = candela::format_of("reference.png", registry);
    candela::write_image(film, png, folder / "reference.png", registry);
    verify::Expectation result{
        .width = image.width,
        .height = image.height,
        .encoding = image.color_management,
        .levels = verify::unrounded_image(scene),
        .sensitivity = verify::sensitivity_of(scene, film, verify::edge_levels(tolerance)),
        .shown = {}};
    const candela::DisplayTransform transform = candela::display_of(scene);
    const candela::Rgb shown = candela::displayed(
        1 / transform.exposure * candela::decoded(image.background, transform.encoding), transform);
    const std::array<float, 3> background{255 * shown.r, 255 * shown.g, 255 * shown.b};
    result.shown.resize(result.levels.size() / 3);
    for (std::size_t i = 0; i < result.levels.size(); ++i) {
        constexpr float k_rounding = 0.01f;
        if (std::abs(result.levels[i] - background[i % 3]) > k_rounding) result.shown[i / 3] = true;
    }
    candela::write_image(verify::mask_of(result.sensitivity.edges, image.width, image.height), png,
                         folder / "edges.png", registry);
    return result;
}

/// Compares the picture drawn by a program.
verify::Verdict verdict_on(const std::string& name, const verify::Expectation& expected,
                           const Workplace& workplace, const fs::path& comparing) {
    const fs::path& folder = workplace.path();
    const fs::path picture = folder / (name + ".png"), decoded = workplace.scratch(name + ".ppm");
    verify::Verdict verdict{.target = name};
    if (!fs::is_regular_file(picture)) {
        verdict.failure = "the program ended without writing a picture";
        return verdict;
    }
    try {
        verdict.comparison =
            verify::compare(comparing, folder / "reference.png", picture, folder / "edges.png",
                            folder / (name + "-difference.png"), decoded);
    } catch (const Error&) {
        if (!fs::is_regular_file(decoded)) throw;
        const verify::RgbImage read = verify::read_ppm(decoded);
        if (read.width == expected.width && read.height == expected.height) throw;
        verdict.failure = fmt::format("the picture has {} x {} pixels; the scene's has {} x {}", read.width,
                                      read.height, expected.width, expected.height);
        return verdict;
    }
    verdict.bias = verify::bias_of(expected, verify::read_ppm(decoded).bytes);
    return verdict;
}

struct Verification {
    std::vector<LoadedTarget> targets;
    std::vector<std::vector<candela::ExportedFile>> programs;  // one for each target
    std::optional<fs::path> program;                           // made earlier; used instead
    verify::Limits limits;
    fs::path comparing;
};

std::vector<verify::Verdict> verdicts_on(const Verification& what, candela::RenderScene& scene,
                                         const Workplace& workplace, candela::Registry& registry) {
    const fs::path& folder = workplace.path();
    std::vector<verify::Verdict> verdicts;
    ProgressBar bar("verifying");
    const std::size_t steps = 1 + 3 * what.targets.size();
    std::size_t done = 0;
    const auto step = [&] { bar.update(++done, steps); };
    const verify::Expectation expected = expectation_of(scene, what.limits.maximum, folder, registry);
    step();
    for (std::size_t i = 0; i < what.targets.size(); ++i) {
        const LoadedTarget& target = what.targets[i];
        const std::string& name = target.name();
        const fs::path program = what.program.value_or(folder / name);
        if (!what.program) write_program(what.programs[i], program);
        target.build(program);
        step();
        target.draw(program, folder / (name + ".png"));
        step();
        verdicts.push_back(verdict_on(name, expected, workplace, what.comparing));
        step();
    }
    return verdicts;
}

/// Throws if the report or the programs in it would overwrite a file that the scene is made from.
void require_no_input_in_report(const std::string& report, const Verification& what,
                                const SceneToExport& scene) {
    std::vector<fs::path> names = Workplace::images_of(what.targets);
    names.emplace_back("index.html");
    for (std::size_t i = 0; i < what.targets.size() && !what.program; ++i)
        for (const fs::path& name : names_of(what.programs[i]))
            names.push_back(what.targets[i].name() / name);
    require_no_input_in(report, names, scene, "report");
}

}  // namespace

int run_verify(const std::vector<std::string>& arguments) {
    candela::Registry installed(candela::plugin_search_path({}));
    const std::string help =
        target_names(installed) + ", or all: those made from the formulas of the scene's models";
    CommandLine line(
        "candela verify [SCENE...] [options]",
        "Generate programs from a scene, build and run them, and compare their pictures with Candela's own. "
        "Exit code 4 means that a picture differs, away from edges, by more than the tolerance or by 0.1 on "
        "average; that it is brighter, darker or displaced as a whole (docs/user/exporting.md has the "
        "limits); or that too little is visible to decide.");
    line.options()("target,t", po::value<std::string>()->value_name("NAME")->default_value("all"),
                   help.c_str())("tolerance",
                                 po::value<double>()->value_name("LEVELS")->default_value(2, "2"),
                                 "the allowed difference of a pixel away from edges, in levels (1/255)")(
        "report", po::value<std::string>()->value_name("DIR"),
        "keep the programs, the pictures, their differences, and a page showing them in this folder")(
        "program", po::value<std::string>()->value_name("DIR"),
        "compare the program generated earlier in this folder, not a new one")("json",
                                                                               "print the figures as JSON");
    add_models_option(line);
    add_approximate_option(line);
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    const fs::path comparing = comparing_program();  // before building anything for it
    candela::Registry registry = registry_from(line);
    std::vector<LoadedTarget> chosen = targets_from(line, registry);
    const verify::Limits limits = limits_from(line);

    candela::Diagnostics diagnostics;
    auto scene = scene_to_export(line, registry, diagnostics);
    report(diagnostics);
    if (!scene) return static_cast<int>(exit_code_of(diagnostics));
    Verification what{.targets = std::move(chosen),
                      .programs = {},
                      .program = {},
                      .limits = limits,
                      .comparing = comparing};
    if (line.has("program")) what.program = line.get<std::string>("program");
    for (const LoadedTarget& target : what.targets) {
        const candela::SceneExport exported = export_for(target, *scene, line, registry);
        if (!what.program) what.programs.push_back(program_for(target, exported, line).files);
    }
    std::optional<std::string> report_folder;
    if (line.has("report")) {
        report_folder = line.get<std::string>("report");
        require_no_input_in_report(*report_folder, what, *scene);
    }

    Workplace workplace(report_folder);
    std::vector<verify::Verdict> verdicts;
    try {
        verdicts = verdicts_on(what, scene->compiled, workplace, registry);
    } catch (const Error& problem) {
        // Keep the report even if something went wrong.
        workplace.finish(what.targets);
        throw Error(problem.category(), workplace.in_place(problem.what()), problem.help());
    }
    std::cout << (line.has("json") ? verify::json_of(verdicts, limits) : verify::table_of(verdicts, limits));
    bool all_match = true;
    for (const verify::Verdict& v : verdicts)
        all_match = all_match && v.outcome(limits) == verify::Outcome::match;
    if (report_folder) {
        candela::write_text_file(workplace.path() / "index.html",
                                 verify::report_page(scene->title, verdicts, limits));
        workplace.finish(what.targets);
        say(fmt::format("report: {}\n", (fs::path(*report_folder) / "index.html").string()));
    }
    return static_cast<int>(all_match ? ExitCode::ok : ExitCode::verification_failed);
}
