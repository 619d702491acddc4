// candela animate: renders an animated scene to frames or a film.
#include <fmt/format.h>

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "cli/commands.h"
#include "cli/outputs.h"
#include "color_view/color_view.h"
#include "commands/animation_output.h"
#include "commands/view_option.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "console/terminal.h"
#include "files/output_folder.h"
#include "film/film_encoding.h"
#include "film/frame_pattern.h"
#include "film/frame_writer.h"
#include "film/render_cache.h"
#include "render/darkness_diagnosis.h"
#include "sandbox/temporary_folder.h"

import candela.render;
import candela.scene;
import candela.util;

namespace po = boost::program_options;
namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// Renders frames one after another.
class FrameRenderer {
  public:
    FrameRenderer(candela::SceneFrames& frames, candela::Registry& registry,
                  const candela::OutputFormat& format, ColorView* view, int threads)
        : frames_(frames),
          format_(format),
          view_(view),
          threads_(threads),
          builder_(registry),
          fingerprints_(registry, format),
          writer_(registry, format, threads) {
        if (view != nullptr) fingerprints_.depend_on(view->text(), view->config());
    }

    /// Renders the frame if it is missing, out of date or `is_forced`. Returns whether it did.
    bool render(int frame, const fs::path& file, bool is_forced) {
        candela::Diagnostics known;  // already reported when all frames were checked
        const candela::SceneDraft draft = frames_.draft(frame, known);
        require_no_scene_file(file.string(), candela::input_files(draft), "the frames");
        const std::string inputs = fingerprints_.of(draft);
        if (!is_forced && is_up_to_date(file, inputs, candela::Links::not_followed)) return false;
        const candela::RenderScene* const scene = builder_.build(draft, known, threads_);
        if (scene == nullptr) {
            report(known);
            throw Error(
                ErrorCategory::failure,
                fmt::format("frame {} can no longer be rendered: a file of the scene has changed", frame));
        }
        if (!builder_.has_kept_triangles()) renderer_.forget();
        candela::Film& film = film_for(*scene);
        const auto statistics = renderer_.render(*scene, film, {.threads = threads_});
        warn_if_dark(*scene, film, statistics, frame);
        if (view_ == nullptr)
            writer_.write(film, file, inputs);
        else
            writer_.write(view_->applied(film, candela::exposure_factor(scene->observer.exposure)), file,
                          inputs);
        return true;
    }

    /// Waits until all frames are written.
    void finish() { writer_.finish(); }

  private:
    candela::Film& film_for(const candela::RenderScene& scene) {
        const candela::DisplayTransform transform = candela::display_of(scene);
        if (!film_ || transform_ != transform) {
            film_.emplace(scene.image.width, scene.image.height,
                          view_ != nullptr ? candela::PixelType::real : format_.pixels, transform);
            transform_ = transform;
        }
        return *film_;
    }

    void warn_if_dark(const candela::RenderScene& scene, const candela::Film& film,
                      const candela::RenderStatistics& statistics, int frame) {
        const std::string darkness = candela::darkness_diagnosis(scene, film, statistics);
        if (!darkness.empty() && said_.insert(darkness).second)
            warn(fmt::format("nothing in frame {} is lit: {}", frame, darkness));
    }

    candela::SceneFrames& frames_;
    candela::OutputFormat format_;
    ColorView* view_;
    int threads_;
    candela::FrameBuilder builder_;
    candela::Renderer renderer_{candela::Renderer::Keep::visibility};
    InputFingerprints fingerprints_;
    FrameWriter writer_;
    std::optional<candela::Film> film_;
    candela::DisplayTransform transform_;
    std::set<std::string> said_;
};

int animate(const CommandLine& line) {
    if (!line.has("scene")) throw Error(ErrorCategory::bad_request, "candela animate needs a scene file");
    if (line.has("resume") && line.has("force"))
        throw Error(ErrorCategory::bad_request, "--resume and --force contradict each other");

    const Stopwatch total;
    const AnimationOutputs outputs = animation_outputs_from(line);
    const int threads = threads_from(line);
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = format_of_frames(line, outputs, registry);
    const std::unique_ptr<ColorView> view = view_from(line, format);

    candela::Diagnostics diagnostics;
    auto frames =
        candela::SceneFrames::read(scene_request_from(line, registry, Models::moving), registry, diagnostics);
    if (frames && !frames->animation() && !frames->is_broken()) {
        throw Error(
            ErrorCategory::bad_request,
            "the scene has no [animation]; render it with candela render, or write an animated scene with "
            "candela new --animation");
    }
    std::vector<int> numbers;
    if (frames) numbers = checked_frames_from(line, *frames, registry, diagnostics, threads);
    report(diagnostics);
    if (!frames || diagnostics.has_errors()) return static_cast<int>(exit_code_of(diagnostics));
    require_no_input_among(outputs, *frames, numbers);
    if (view) view->require();

    std::optional<TemporaryFolder> temporary;
    std::optional<FramePattern> pattern = outputs.frames;
    for (const fs::path& film : outputs.films) make_folder(folder_of(film));
    if (!pattern) {
        temporary.emplace(".candela-", folder_of(outputs.films.front()));
        pattern.emplace(escaped_for_pattern(temporary->path().string()) + "/%08d.png");
    }
    make_folder(folder_of(pattern->file_of(numbers.front())));
    std::vector<fs::path> files;
    std::size_t rendered = 0;
    {
        ProgressBar bar("rendering", !is_quiet());
        FrameRenderer renderer(*frames, registry, format, view.get(), threads);
        for (const int number : numbers) {
            files.push_back(pattern->file_of(number));
            if (renderer.render(number, files.back(), line.has("force"))) ++rendered;
            bar.update(files.size(), numbers.size());
        }
        renderer.finish();
    }
    for (const fs::path& film : outputs.films) encode(files, frames->animation()->fps, film);

    say_afterwards([&] {
        std::string names = outputs.frames ? outputs.frames->text() : "";
        for (const fs::path& film : outputs.films) names += (names.empty() ? "" : ", ") + film.string();
        const std::size_t left = files.size() - rendered;
        return fmt::format("{}: {} frame{}{}, {}\n", names, files.size(), files.size() == 1 ? "" : "s",
                           left > 0 ? fmt::format(", {} of them already up to date", left) : "",
                           duration_text(total.milliseconds()));
    });
    return 0;
}

}  // namespace

int run_animate(const std::vector<std::string>& arguments) {
    CommandLine line(
        "candela animate SCENE... [options]",
        "Render the frames of an animated scene to numbered pictures, a film, or both. All frames are "
        "checked before the first is rendered. Frames made from the same scene, files and plugins are kept, "
        "so running the same command again finishes an interrupted run.");
    add_frames_options(line);
    line.options()("resume", "keep frames that are up to date (the default)")(
        "force", "render all frames again")("threads", po::value<int>()->value_name("N"),
                                            "threads to use; default: all cores");
    add_scene_options(line);
    add_view_options(line);
    if (!line.parse(arguments)) return 0;
    return animate(line);
}
