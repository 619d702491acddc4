// candela verify: generates programs, builds and runs them, and compares their pictures with Candela's.
#include <fmt/format.h>

#include <cstdlib>
#include <filesystem>
#include <iostream>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "command_line.h"
#include "exit_code.h"
#include "generating.h"
#include "helper.h"
#include "reporting.h"
#include "targets.h"
#include "terminal.h"
#include "verbs.h"
#include "verify/comparison.h"
#include "verify/edges.h"
#include "verify/report.h"

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// The folder of the report, or one that is gone when this is.
class Workplace {
  public:
    explicit Workplace(const std::optional<std::string>& report) {
        if (report) {
            path_ = *report;
            std::error_code problem;
            fs::create_directories(path_, problem);
            if (!fs::is_directory(path_))
                throw Error(ErrorCategory::failure,
                            fmt::format("the folder '{}' cannot be made", path_.string()));
            return;
        }
        std::string name = (fs::temp_directory_path() / "candela-verify-XXXXXX").string();
        if (::mkdtemp(name.data()) == nullptr)
            throw Error(ErrorCategory::failure,
                        fmt::format("no folder can be made in {}", fs::temp_directory_path().string()));
        path_ = name;
        is_temporary_ = true;
    }
    Workplace(const Workplace&) = delete;
    Workplace& operator=(const Workplace&) = delete;
    ~Workplace() {
        std::error_code ignored;
        if (is_temporary_) fs::remove_all(path_, ignored);
    }
    const fs::path& path() const { return path_; }

  private:
    fs::path path_;
    bool is_temporary_ = false;
};

std::vector<LoadedTarget> targets_from(const CommandLine& line, candela::Registry& registry) {
    const auto name = line.get<std::string>("target");
    const bool is_all = name == "all";
    if (is_all && line.has("program")) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--program is the folder of one program; say which with --target {}",
                                target_names(registry, " or ")));
    }
    std::vector<LoadedTarget> chosen;
    if (is_all) {
        for (const std::string& each : registry.names(candela::PluginKind::target)) {
            LoadedTarget target(each, registry);
            if (target.can_draw()) chosen.push_back(std::move(target));
        }
        return chosen;
    }
    chosen.emplace_back(name, registry);
    if (!chosen.front().can_draw())
        throw Error(ErrorCategory::bad_request,
                    fmt::format("target/{} draws no picture that could be compared", name));
    return chosen;
}

verify::Limits limits_from(const CommandLine& line) {
    verify::Limits limits;
    limits.maximum = line.get<double>("tolerance");
    if (!(limits.maximum >= 0 && limits.maximum <= 255))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--tolerance is {:g}; it can be 0 to 255", limits.maximum));
    return limits;
}

}  // namespace

int run_verify(const std::vector<std::string>& arguments) {
    candela::Registry installed(candela::plugin_search_path({}));
    const std::string help = target_names(installed) + ", or all";
    CommandLine line(
        "candela verify [SCENE...] [options]",
        "Generates programs from a scene, builds and runs them, and compares their pictures with Candela's "
        "own.\n"
        "Exit code 4: one of them differs, away from edges, by more than the tolerance, or by 0.1 on "
        "average.");
    line.options()("target,t", po::value<std::string>()->value_name("NAME")->default_value("all"),
                   help.c_str())("tolerance",
                                 po::value<double>()->value_name("LEVELS")->default_value(2, "2"),
                                 "how much a pixel away from edges may differ, in levels of 1/255")(
        "report", po::value<std::string>()->value_name("DIR"),
        "keep the programs, the pictures, their differences, and a page that shows them")(
        "program", po::value<std::string>()->value_name("DIR"),
        "compare the program generated earlier in this folder instead of a new one");
    add_models_option(line);
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    candela::Registry registry = registry_from(line);
    const std::vector<LoadedTarget> chosen = targets_from(line, registry);
    const verify::Limits limits = limits_from(line);

    candela::Diagnostics diagnostics;
    auto scene = scene_to_export(line, registry, diagnostics);
    report(diagnostics);
    if (!scene) return static_cast<int>(exit_code_of(diagnostics));
    std::vector<candela::SceneExport> exports;
    for (const LoadedTarget& target : chosen) exports.push_back(export_for(target, *scene, line, registry));

    const Workplace workplace(line.has("report") ? std::optional(line.get<std::string>("report"))
                                                 : std::nullopt);
    const fs::path& folder = workplace.path();
    const candela::ImageSettings& image = scene->compiled.image;
    candela::Film film(image.width, image.height, candela::PixelType::byte, image.color_management);
    std::vector<verify::Verdict> verdicts;
    {
        ProgressBar bar("verifying");
        const std::size_t steps = 1 + 3 * chosen.size();
        std::size_t done = 0;
        const auto step = [&] { bar.update(++done, steps); };
        candela::render(scene->compiled, film, {});
        const auto png = candela::format_of("reference.png", registry);
        candela::write_picture(film, png, folder / "reference.png", registry);
        const auto edges = verify::edge_pixels(scene->compiled, film, static_cast<float>(limits.maximum) / 2);
        candela::write_picture(verify::mask_of(edges, image.width, image.height), png, folder / "edges.png",
                               registry);
        step();
        for (std::size_t i = 0; i < chosen.size(); ++i) {
            const LoadedTarget& target = chosen[i];
            const std::string& name = target.name();
            const fs::path program =
                line.has("program") ? fs::path(line.get<std::string>("program")) : folder / name;
            if (!line.has("program")) write_program(target.files_of(exports[i].scene()), program);
            target.build(program);
            step();
            target.draw(program, folder / (name + ".png"));
            step();
            verdicts.push_back(
                {name, verify::compare(beside_command("lib/candela/candela-diff"), folder / "reference.png",
                                       folder / (name + ".png"), folder / "edges.png",
                                       folder / (name + "-difference.png"))});
            step();
        }
    }
    std::cout << verify::table_of(verdicts, limits);
    bool all_match = true;
    for (const verify::Verdict& v : verdicts) all_match = all_match && v.is_match(limits);
    if (line.has("report")) {
        candela::write_text_file(folder / "index.html", verify::report_page(scene->title, verdicts, limits));
        std::cerr << fmt::format("report: {}\n", (folder / "index.html").string());
    }
    return static_cast<int>(all_match ? ExitCode::ok : ExitCode::verification_failed);
}
