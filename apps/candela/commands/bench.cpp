// candela bench: measures each stage of rendering a scene, once everything is warm.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "console/terminal.h"
#include "json/json.h"

import candela.render;
import candela.util;

namespace po = boost::program_options;
using candela::Error;
using candela::ErrorCategory;

namespace {

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

int count_from(const CommandLine& line, const char* flag, int least, int most) {
    const int count = line.get<int>(flag);
    if (count < least || count > most)
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--{} is {}; expected {} to {}", flag, count, least, most));
    return count;
}

/// Milliseconds per frame, by stage.
struct Times {
    std::vector<double> projection, tiles, frame;
    std::vector<double> relit;  // frames in which only the light changes
};

struct Plan {
    int frames, warm_up, threads;
};

Times measure(const candela::RenderScene& scene, const Plan& plan, candela::Film& film,
              candela::RenderStatistics& statistics) {
    Times times;
    ProgressBar bar("measuring");
    const std::size_t all =
        static_cast<std::size_t>(plan.warm_up) + 2 * static_cast<std::size_t>(plan.frames) + 1;
    std::size_t done = 0;
    candela::Renderer renderer;
    for (int i = 0; i < plan.warm_up + plan.frames; ++i) {
        const Stopwatch drawing;
        statistics = renderer.render(scene, film, {.threads = plan.threads});
        const double milliseconds = drawing.milliseconds();
        bar.update(++done, all);
        if (i < plan.warm_up) continue;
        times.frame.push_back(milliseconds);
        times.projection.push_back(1e3 * statistics.seconds_projecting);
        times.tiles.push_back(1e3 * statistics.seconds_on_tiles);
    }
    renderer = candela::Renderer(candela::Renderer::Keep::visibility);
    for (int i = 0; i < 1 + plan.frames; ++i) {
        const Stopwatch lighting;
        renderer.render(scene, film, {.threads = plan.threads});
        if (i > 0) times.relit.push_back(lighting.milliseconds());
        bar.update(++done, all);
    }
    return times;
}

void print_text(const Json& f) {
    const auto number = [&](const char* key) { return f.at(key).get<double>(); };
    std::cout << fmt::format("{} x {}, {} sample(s), {} triangles, {}\n", f.at("width").get<int>(),
                             f.at("height").get<int>(), f.at("samples").get<int>(),
                             f.at("triangles").get<std::size_t>(), f.at("instruction_set").get<std::string>())
              << fmt::format("  scene        {:9.3f} ms  once\n  meshes       {:9.3f} ms  once\n",
                             number("read_ms"), number("meshes_ms"))
              << fmt::format("  projection   {:9.3f} ms\n  tiles        {:9.3f} ms\n",
                             number("projection_ms"), number("tiles_ms"))
              << fmt::format("  frame        {:9.3f} ms  median of {}, fastest {:.3f}\n", number("frame_ms"),
                             f.at("frames").get<int>(), number("fastest_frame_ms"))
              << fmt::format("  relit        {:9.3f} ms  if only lights or materials change\n",
                             number("relit_frame_ms"))
              << fmt::format(
                     "  {:.4g} Mpixel/s, {:.4g} Msample/s, {:.4g} M points lit/s, {:.4g} Mtriangle/s\n",
                     number("mpixels_per_second"), number("msamples_per_second"),
                     number("mpoints_lit_per_second"), number("mtriangles_per_second"));
}

}  // namespace

int run_bench(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela bench [SCENE...] [options]",
        "Render a scene again and again within one process, and print the median times of its stages and the "
        "rates they amount to. The scene is read, and its triangles are made, once.");
    line.options()("frames", po::value<int>()->value_name("N")->default_value(50),
                   "frames to measure, 1 to 100000")("warm-up",
                                                     po::value<int>()->value_name("N")->default_value(5),
                                                     "frames to render first, 0 to 100000")(
        "threads", po::value<int>()->value_name("N")->default_value(0), "threads to use; 0: all cores")(
        "json", "print the results as JSON");
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    const Plan plan{.frames = count_from(line, "frames", 1, 100000),
                    .warm_up = count_from(line, "warm-up", 0, 100000),
                    .threads = count_from(line, "threads", 0, 1024)};

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    const Stopwatch reading;
    const auto draft = candela::draft_scene(scene_request_from(line, registry), registry, diagnostics);
    const double read_ms = reading.milliseconds();
    const Stopwatch compiling;
    const auto scene = draft ? candela::build(*draft, registry, diagnostics, plan.threads) : std::nullopt;
    const double compile_ms = compiling.milliseconds();
    report(diagnostics);
    if (!scene) return static_cast<int>(exit_code_of(diagnostics));

    const candela::ImageSettings& image = scene->image;
    candela::Film film(image.width, image.height, candela::PixelType::byte, candela::display_of(*scene));
    candela::RenderStatistics statistics;
    const Times times = measure(*scene, plan, film, statistics);
    const double frame = median_of(times.frame);
    const auto per_second = [&](double count) { return count / frame / 1e3; };  // in millions
    const double pixels = static_cast<double>(film.width()) * static_cast<double>(film.height());
    const Json figures = {{"width", film.width()},
                          {"height", film.height()},
                          {"samples", image.samples},
                          {"triangles", statistics.triangles},
                          {"frames", plan.frames},
                          {"threads", plan.threads},
                          {"instruction_set", candela::name_of(candela::instruction_set())},
                          {"read_ms", read_ms},
                          {"meshes_ms", compile_ms},
                          {"projection_ms", median_of(times.projection)},
                          {"tiles_ms", median_of(times.tiles)},
                          {"frame_ms", frame},
                          {"fastest_frame_ms", std::ranges::min(times.frame)},
                          {"relit_frame_ms", median_of(times.relit)},
                          {"mpixels_per_second", per_second(pixels)},
                          {"msamples_per_second", per_second(pixels * image.samples)},
                          {"mpoints_lit_per_second", per_second(static_cast<double>(statistics.points_lit))},
                          {"mtriangles_per_second", per_second(static_cast<double>(statistics.triangles))}};
    if (line.has("json")) {
        std::cout << json_text(figures, 2) << '\n';
    } else {
        print_text(figures);
    }
    return 0;
}
