// candela render: a scene becomes a picture.
#include <fmt/format.h>
#include <unistd.h>

#include <iostream>
#include <optional>
#include <string>

#include "command_line.h"
#include "exit_code.h"
#include "reporting.h"
#include "stopwatch.h"
#include "terminal.h"
#include "verbs.h"

import candela.parallel;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// "7.3 ms", "1.37 s".
std::string duration_text(double milliseconds) {
    return milliseconds < 1000 ? fmt::format("{:.3g} ms", milliseconds)
                               : fmt::format("{:.3g} s", milliseconds / 1000);
}

int threads_from(const CommandLine& line) {
    if (!line.has("threads")) return 0;
    const int threads = line.get<int>("threads");
    if (threads < 1 || threads > 1024) {
        throw Error(ErrorCategory::bad_request, fmt::format("--threads is {}; it can be 1 to 1024", threads));
    }
    return threads;
}

}  // namespace

int run_render(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela render [SCENE...] [options]",
        "Renders a scene, or several files that together are one, to a picture. Without a scene: the "
        "default\n"
        "scene, one cube and one point light. The format follows the extension of the picture's name.");
    line.options()("output,o", po::value<std::string>()->value_name("FILE")->default_value("candela.png"),
                   "the picture; - writes a PNG to standard output");
    add_scene_options(line);
    line.options()("threads", po::value<int>()->value_name("N"),
                   "threads to use; default: all cores, or one for a small picture")(
        "verbose", "print how long each stage took");
    if (!line.parse(arguments)) return 0;

    const Stopwatch total;
    const auto output = line.get<std::string>("output");
    if (output == "-" && ::isatty(STDOUT_FILENO) == 1) {
        throw Error(ErrorCategory::bad_request,
                    "-o - would print a PNG on this terminal; send it to a file or a pipe");
    }
    const int threads = threads_from(line);
    candela::Registry registry = registry_from(line);
    const candela::PictureFormat format = candela::format_of(output, registry);

    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(scene_request_from(line), registry, diagnostics);
    const double read_ms = total.milliseconds();
    const Stopwatch compiling;
    const auto compiled = draft ? candela::compile(*draft, registry, diagnostics, threads) : std::nullopt;
    const double compile_ms = compiling.milliseconds();
    report(diagnostics);
    if (!compiled) return static_cast<int>(exit_code_of(diagnostics));

    const candela::ImageSettings& image = compiled->image;
    candela::Film film(image.width, image.height, format.pixels, image.color_management);
    candela::RenderStatistics statistics;
    {
        ProgressBar bar("rendering");
        const candela::RenderOptions options{
            .threads = threads,
            .progress = [&](std::size_t done, std::size_t all) { bar.update(done, all); }};
        statistics = candela::render(*compiled, film, options);
    }
    const std::string darkness = candela::why_black(*compiled, film, statistics);
    if (!darkness.empty())
        std::cerr << fmt::format("candela: warning: nothing in the picture is lit: {}\n", darkness);
    const Stopwatch writing;
    // A pixel takes its encoder some three nanoseconds.
    candela::with_threads(
        threads, [&] { candela::write_picture(film, format, output, registry); },
        3e-6 * film.width() * film.height());
    const double write_ms = writing.milliseconds();

    if (line.has("verbose")) {
        std::cerr << fmt::format(
            "  scene      {:8.2f} ms\n  meshes     {:8.2f} ms\n  projection {:8.2f} ms\n  tiles      {:8.2f} "
            "ms  ({} points lit, {})\n"
            "  writing    {:8.2f} ms\n",
            read_ms, compile_ms, 1e3 * statistics.seconds_projecting, 1e3 * statistics.seconds_on_tiles,
            statistics.points_lit, candela::name_of(candela::instruction_set()), write_ms);
    }
    std::cerr << fmt::format("{}: {} x {}, {} triangle{}, {} pixels shaded, {}\n",
                             output == "-" ? "picture" : output, film.width(), film.height(),
                             statistics.triangles, statistics.triangles == 1 ? "" : "s",
                             statistics.pixels_shaded, duration_text(total.milliseconds()));
    return 0;
}
