#include "commands/animation_output.h"

#include <fmt/format.h>

#include "cli/output_format.h"
#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "film/film_encoding.h"

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

void add_frames_options(CommandLine& line) {
    line.options()(
        "output,o", po::value<std::vector<std::string>>()->value_name("FILE"),
        "frames, such as frames/%04d.png (the default), or a film (.mp4, .webm or .gif, made by ffmpeg); "
        "repeat it for both")("frames", po::value<std::string>()->value_name("A..B"),
                              "render only these frames; default: all")(
        "step", po::value<int>()->value_name("N")->default_value(1), "render every N-th frame");
    add_format_option(line);
}

AnimationOutputs animation_outputs_from(const CommandLine& line) {
    AnimationOutputs outputs;
    for (const std::string& output : line.all("output")) {
        if (is_film(output) && output.find('%') == std::string::npos) {
            outputs.films.emplace_back(output);
        } else if (outputs.frames) {
            throw Error(
                ErrorCategory::bad_request,
                fmt::format("-o names frames twice: '{}' and '{}'; expected one frame pattern, and films",
                            outputs.frames->text(), output));
        } else {
            outputs.frames.emplace(output);
        }
    }
    if (!outputs.frames && outputs.films.empty()) {
        outputs.frames.emplace("frames/%04d.png");
        require_no_default_link(line, "output", "frames");
    }
    for (const fs::path& film : outputs.films) require_encoder(film);
    return outputs;
}

candela::OutputFormat format_of_frames(const CommandLine& line, const AnimationOutputs& outputs,
                                       candela::Registry& registry) {
    candela::OutputFormat format =
        output_format_from(line, outputs.frames ? outputs.frames->file_of(0) : fs::path("0.png"), registry);
    // ffmpeg reads 8-bit pictures as display-encoded.
    if (outputs.frames && !outputs.films.empty() && format.pixels != candela::PixelType::byte) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("a film needs 8-bit frames, but '{}' holds floats; use -o frames/%04d.png",
                                outputs.frames->text()));
    }
    return format;
}

std::vector<int> checked_frames_from(const CommandLine& line, candela::SceneFrames& frames,
                                     candela::Registry& registry, candela::Diagnostics& diagnostics,
                                     int threads) {
    if (!frames.animation()) {
        static_cast<void>(frames.draft(0, diagnostics));
        return {};
    }
    const auto range = line.has("frames") ? std::optional(line.get<std::string>("frames")) : std::nullopt;
    std::vector<int> numbers = frames_from(range, line.get<int>("step"), frames.count());
    check_all_frames(frames, numbers, registry, diagnostics, threads);
    return numbers;
}

void require_no_input_among(const AnimationOutputs& outputs, candela::SceneFrames& frames,
                            const std::vector<int>& numbers) {
    candela::Diagnostics known;
    const auto inputs = candela::input_files(frames.draft(numbers.front(), known));
    for (std::size_t i = 0; outputs.frames && i < numbers.size(); ++i)
        require_no_scene_file(outputs.frames->file_of(numbers[i]).string(), inputs, "the frames");
    for (const fs::path& film : outputs.films) require_no_scene_file(film.string(), inputs, "the film");
}
