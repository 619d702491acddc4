// candela render: renders a scene to a picture.
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "aov/terms.h"
#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/model_scene.h"
#include "cli/output_format.h"
#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "commands/luminance_option.h"
#include "commands/part_rendering.h"
#include "commands/row_rendering.h"
#include "commands/view_option.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "console/terminal.h"
#include "render/clipping.h"
#include "render/darkness_diagnosis.h"
#include "sandbox/temporary_folder.h"

import candela.api;
import candela.render;
import candela.scene;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// The terms that --terms names.
std::vector<NamedTerm> terms_asked_for(const CommandLine& line, const candela::Scene& scene) {
    if (!line.has("terms")) return {};
    if (line.get<std::string>("output") == "-")
        throw Error(ErrorCategory::bad_request,
                    "--terms writes layers, or files next to the picture; name a file with -o");
    return terms_from(words_of(line.get<std::string>("terms")), scene, "--terms");
}

/// The files for a picture and its terms.
struct OutputFiles {
    fs::path picture;
    std::vector<fs::path> terms;
    const candela::OutputFormat& format;
    candela::Existing existing;
    LuminanceDisplay luminance;
};

/// Writes the picture and its terms, all of them or none.
void write_images(const candela::Film& film, const std::vector<NamedTerm>& terms, TermRenderer& renderer,
                  OutputFiles files, int threads, candela::Registry& registry) {
    candela::OutputFile picture(files.picture, files.existing);
    // Encoding takes about three nanoseconds per pixel.
    candela::with_threads(
        threads, [&] { candela::write_image(film, files.format, picture, registry); },
        3e-6 * film.width() * film.height());
    std::vector<std::unique_ptr<candela::OutputFile>> others;
    for (std::size_t i = 0; i < files.terms.size(); ++i) {
        others.push_back(std::make_unique<candela::OutputFile>(files.terms[i], files.existing,
                                                               candela::Links::not_followed));
        candela::write_image(renderer.image(terms[i], files.format.pixels, files.luminance), files.format,
                             *others.back(), registry);
        others.back()->complete();
    }
    if (others.empty()) return picture.finish();
    picture.complete();
    const WithoutInterruption during_this;
    for (const auto& other : others) other->finish();
    picture.finish();
}

int render_image(const CommandLine& line) {
    const Stopwatch total;
    const auto output = line.get<std::string>("output");
    require_no_terminal(output);
    const candela::Existing existing = existing_from(line);
    require_free(output, existing);
    require_no_default_link(line, "output", output);
    const int threads = threads_from(line);
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = output_format_from(line, output, registry);
    const LuminanceDisplay luminance = luminance_display_from(line);
    // Its libraries are loaded while the scene is read.
    const std::unique_ptr<ColorView> view = view_from(line, format);

    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(scene_request_from(line, registry), registry, diagnostics);
    if (draft) require_no_scene_file(output, candela::input_files(*draft), "the picture");
    std::vector<NamedTerm> terms;
    std::vector<fs::path> term_files;
    if (draft && draft->is_complete) {
        terms = terms_asked_for(line, draft->scene);
        if (!format.has_layers) term_files = files_of(terms, output);
    }
    for (const fs::path& file : term_files) {
        require_free(file.string(), existing);
        require_no_scene_file(file.string(), candela::input_files(*draft), "the picture");
    }
    const double read_ms = total.milliseconds();
    const Stopwatch compiling;
    const auto compiled = draft ? compile_scene(*draft, registry, diagnostics, threads) : std::nullopt;
    const double compile_ms = compiling.milliseconds();
    report(diagnostics);
    if (!compiled) return static_cast<int>(exit_code_of(diagnostics));

    const candela::ImageSettings& image = compiled->image;
    if (view) view->require();
    if (is_streamed(image, format, registry) && terms.empty() && !view)
        return render_by_rows(line, *compiled, format, existing, registry, total);
    std::optional<candela::Film> made;
    try {
        made.emplace(image.width, image.height, view ? candela::PixelType::real : format.pixels,
                     candela::display_of(*compiled));
    } catch (const Error& problem) {
        candela::Diagnostics too_large;
        too_large.failure(draft->image_place, problem.what());
        report(too_large);
        return static_cast<int>(ExitCode::failure);
    }
    candela::Film& film = *made;
    candela::RenderStatistics statistics;
    {
        ProgressBar bar("rendering", !is_quiet());
        const candela::RenderOptions options{
            .threads = threads,
            .progress = [&](std::size_t done, std::size_t all) { bar.update(done, all); }};
        statistics = candela::render(*compiled, film, options);
    }
    const std::string darkness = candela::darkness_diagnosis(*compiled, film, statistics);
    if (!darkness.empty()) warn("nothing in the picture is lit: " + darkness);
    const std::string clipping = candela::clipping_diagnosis(*compiled, film, statistics);
    if (!clipping.empty()) warn(clipping);
    if (view) made = view->applied(film, candela::exposure_factor(compiled->observer.exposure));
    const bool is_verbose = line.has("verbose");
    const Stopwatch writing;
    TermRenderer term_renderer(*compiled, threads);
    if (format.has_layers && !terms.empty()) {
        write_with_layers(film, terms, term_renderer, format, output, registry, existing);
    } else {
        write_images(film, terms, term_renderer, {output, term_files, format, existing, luminance}, threads,
                     registry);
    }
    const double write_ms = writing.milliseconds();

    say_afterwards([&] {
        std::string stages;
        if (is_verbose) {
            stages = fmt::format(
                "  scene      {:8.2f} ms\n  meshes     {:8.2f} ms\n  projection {:8.2f} ms\n  tiles      "
                "{:8.2f} ms  ({} "
                "points lit, {})\n  writing    {:8.2f} ms\n",
                read_ms, compile_ms, 1e3 * statistics.seconds_projecting, 1e3 * statistics.seconds_on_tiles,
                statistics.points_lit, candela::name_of(candela::instruction_set()), write_ms);
        }
        std::string with_terms;
        if (!terms.empty()) {
            with_terms = fmt::format(", {} term{} {}", terms.size(), terms.size() == 1 ? "" : "s",
                                     format.has_layers ? "as layers" : "in files next to it");
        }
        return stages + fmt::format("{}: {} x {}, {} triangle{}, {} pixels shaded{}, {}\n",
                                    output == "-" ? "picture" : output, film.width(), film.height(),
                                    statistics.triangles, statistics.triangles == 1 ? "" : "s",
                                    statistics.pixels_shaded, with_terms,
                                    duration_text(total.milliseconds()));
    });
    return 0;
}

}  // namespace

int run_render(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela render [SCENE...] [options]",
        "Render a scene, from one file or several combined, to a picture. Without a scene, render the "
        "default scene: one cube and one point light. The picture's file extension selects the format.");
    line.options()("output,o", po::value<std::string>()->value_name("FILE")->default_value("candela.png"),
                   "the picture; -: write a PNG to standard output");
    add_scene_options(line);
    add_format_option(line);
    add_frame_option(line);
    line.options()("threads", po::value<int>()->value_name("N"),
                   "threads to use; default: all cores, or one for a small picture")(
        "terms", po::value<std::string>()->value_name("TERM,..."),
        "also write the terms that make up the picture: diffuse, specular, normal, depth, light.NAME ... or "
        "all "
        "(docs/user/explaining.md); as layers of an .exr, otherwise as files next to the picture");
    add_luminance_option(line);
    add_view_options(line);
    line.options()(
        "part", po::value<std::string>()->value_name("K/N"),
        "render only the K-th of N bands of rows, into the folder FILE.parts; candela assemble combines "
        "them")("verbose", "print how long each stage took");
    add_no_clobber_option(line);
    if (!line.parse(arguments)) return 0;
    if (line.has("part")) return render_part(line);
    if (has_model(line)) expect_models();
    return render_image(line);
}
