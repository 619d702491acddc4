// candela bench: how long a scene takes, stage by stage, once everything is warm.
#include <fmt/format.h>

#include <algorithm>
#include <iostream>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "command_line.h"
#include "stopwatch.h"
#include "terminal.h"
#include "verbs.h"

namespace po = boost::program_options;
using candela::Error;
using candela::ExitCode;

namespace {

double median_of(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::ranges::nth_element(values, middle);
    return *middle;
}

int count_from(const CommandLine& line, const char* flag, int least, int most) {
    const int count = line.get<int>(flag);
    if (count < least || count > most)
        throw Error(ExitCode::usage, fmt::format("--{} is {}; it can be {} to {}", flag, count, least, most));
    return count;
}

/// Milliseconds of each frame, by stage.
struct Times {
    std::vector<double> projection, tiles, frame;
};

}  // namespace

int run_bench(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela bench [SCENE...] [options]",
        "Renders a scene again and again within one process, and prints the median times of its stages\n"
        "and what they come to. The scene is read, and its triangles are made, once.");
    line.options()("frames", po::value<int>()->value_name("N")->default_value(50),
                   "frames to measure, 1 to 100000")(
        "warm-up", po::value<int>()->value_name("N")->default_value(5), "frames before that, 0 to 100000")(
        "threads", po::value<int>()->value_name("N")->default_value(0), "processors to use; 0: all")(
        "json", "print the figures as JSON");
    add_scene_options(line);
    if (!line.parse(arguments)) return 0;
    const int frames = count_from(line, "frames", 1, 100000);
    const int warm_up = count_from(line, "warm-up", 0, 100000);
    const int threads = count_from(line, "threads", 0, 1024);

    candela::Registry registry = registry_from(line);
    candela::Diagnostics diagnostics;
    const Stopwatch total;
    const auto draft = candela::draft_scene(scene_request_from(line), registry, diagnostics);
    const double read_ms = total.milliseconds();
    const Stopwatch compiling;
    const auto scene = draft ? candela::compile(*draft, registry, diagnostics) : std::nullopt;
    const double compile_ms = compiling.milliseconds();
    std::cerr << diagnostics.text(stderr_takes_color());
    if (!scene) return static_cast<int>(diagnostics.exit_code());

    candela::Film film(scene->image.width, scene->image.height, candela::PixelType::byte,
                       scene->image.color_management);
    Times times;
    candela::RenderStatistics statistics;
    {
        ProgressBar bar("measuring");
        for (int i = 0; i < warm_up + frames; ++i) {
            const Stopwatch drawing;
            statistics = candela::render(*scene, film, {.threads = threads});
            const double frame_ms = drawing.milliseconds();
            bar.update(static_cast<std::size_t>(i) + 1,
                       static_cast<std::size_t>(warm_up) + static_cast<std::size_t>(frames));
            if (i < warm_up) continue;
            times.frame.push_back(frame_ms);
            times.projection.push_back(1e3 * statistics.seconds_projecting);
            times.tiles.push_back(1e3 * statistics.seconds_on_tiles);
        }
    }
    const double frame = median_of(times.frame);
    const double pixels = static_cast<double>(film.width()) * static_cast<double>(film.height());
    const auto per_second = [&](double count) { return count / frame / 1e3; };  // in millions
    const nlohmann::ordered_json figures = {
        {"width", film.width()},
        {"height", film.height()},
        {"frames", frames},
        {"threads", threads},
        {"instruction_set", candela::name_of(candela::instruction_set())},
        {"read_ms", read_ms},
        {"meshes_ms", compile_ms},
        {"projection_ms", median_of(times.projection)},
        {"tiles_ms", median_of(times.tiles)},
        {"frame_ms", frame},
        {"fastest_frame_ms", std::ranges::min(times.frame)},
        {"mpixels_per_second", per_second(pixels)},
        {"msamples_per_second", per_second(pixels * scene->image.samples)},
        {"mpoints_lit_per_second", per_second(static_cast<double>(statistics.points_lit))},
        {"mtriangles_per_second", per_second(static_cast<double>(statistics.triangles))}};
    if (line.has("json")) {
        std::cout << figures.dump(2) << '\n';
        return 0;
    }
    std::cout << fmt::format("{} x {}, {} sample{}, {} triangles, {}\n", film.width(), film.height(),
                             scene->image.samples, scene->image.samples == 1 ? "" : "s", statistics.triangles,
                             candela::name_of(candela::instruction_set()));
    std::cout << fmt::format("  scene        {:9.3f} ms  once\n  meshes       {:9.3f} ms  once\n", read_ms,
                             compile_ms);
    std::cout << fmt::format(
        "  projection   {:9.3f} ms\n  tiles        {:9.3f} ms\n  frame        {:9.3f} ms  median of {}, "
        "fastest {:.3f}\n",
        median_of(times.projection), median_of(times.tiles), frame, frames, std::ranges::min(times.frame));
    std::cout << fmt::format(
        "  {:.4g} Mpixel/s, {:.4g} Msample/s, {:.4g} M points lit/s, {:.4g} Mtriangle/s\n",
        per_second(pixels), per_second(pixels * scene->image.samples),
        per_second(static_cast<double>(statistics.points_lit)),
        per_second(static_cast<double>(statistics.triangles)));
    return 0;
}
