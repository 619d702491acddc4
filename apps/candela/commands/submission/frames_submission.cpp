// The frames of an animation as tasks.
#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <initializer_list>
#include <memory>
#include <string>
#include <vector>

#include "commands/animation_output.h"
#include "commands/submission/job_submission.h"
#include "commands/view_option.h"
#include "film/render_cache.h"
#include "programs/shell_words.h"

import candela.render;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// Enough frames to make starting a task negligible, and no more tasks than a queue accepts by default.
std::size_t frames_per_task(const CommandLine& line, std::size_t frames) {
    constexpr std::size_t k_worth_starting = 10, k_most_tasks = 1000;
    if (line.has("chunk")) return static_cast<std::size_t>(count_from(line, "chunk", 1'000'000));
    return std::max(k_worth_starting, (frames + k_most_tasks - 1) / k_most_tasks);
}

Words with(Words words, std::initializer_list<std::string> more) {
    words.insert(words.end(), more);
    return words;
}

}  // namespace

std::optional<Submission> submission_of_frames(const CommandLine& line, int threads,
                                               candela::Diagnostics& diagnostics) {
    const AnimationOutputs outputs = animation_outputs_from(line);
    if (!outputs.frames) {
        throw Error(ErrorCategory::bad_request,
                    fmt::format("a film's tasks share its frames, so they need file names; use -o "
                                "frames/%04d.png -o {}",
                                quoted_for_shell(outputs.films.front().string())));
    }
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = format_of_frames(line, outputs, registry);
    const std::unique_ptr<ColorView> view = view_from(line, format);
    bool has_asked = false;
    const candela::SceneRequest request = repeatable_request_from(line, registry, has_asked, Models::moving);
    auto frames = candela::SceneFrames::read(request, registry, diagnostics);
    if (frames && !frames->animation() && !frames->is_broken()) {
        throw Error(
            ErrorCategory::bad_request,
            "the scene has no [animation], so there are no frames to distribute; --parts 16 distributes its "
            "picture");
    }
    std::vector<int> numbers;
    if (frames) numbers = checked_frames_from(line, *frames, registry, diagnostics, 0);
    if (!frames || diagnostics.has_errors()) return std::nullopt;
    require_no_input_among(outputs, *frames, numbers);
    if (view) view->require();

    const FramePattern& pattern = *outputs.frames;
    Submission job{.plan = {},
                   .folder = JobFolder::of_output(pattern.text()),
                   .commands = {},
                   .last = {},
                   .open = {},
                   .queue_options = {}};
    job.plan.output = pattern.text();
    Words common = with(common_words(line, "animate", has_asked), {"--output=" + pattern.text()});
    if (const int step = line.get<int>("step"); step > 1) common.push_back(fmt::format("--step={}", step));
    const auto frames_word = [](int first, int last) { return fmt::format("--frames={}..{}", first, last); };
    const std::size_t chunk = frames_per_task(line, numbers.size());
    InputFingerprints fingerprints(registry, format);
    if (view) {
        fingerprints.depend_on(view->text(), view->config());
        for (const std::string& word : view_words_from(line, *view)) common.push_back(word);
    }
    for (std::size_t begin = 0; begin < numbers.size(); begin += chunk) {
        const std::size_t end = std::min(begin + chunk, numbers.size());
        JobTask task{fmt::format("{}..{}", numbers[begin], numbers[end - 1]), {}};
        for (std::size_t i = begin; i < end; ++i) {
            candela::Diagnostics known;
            task.files.push_back(
                {pattern.file_of(numbers[i]), fingerprints.of(frames->draft(numbers[i], known))});
        }
        const Words words = with(
            common, {fmt::format("--threads={}", threads), frames_word(numbers[begin], numbers[end - 1])});
        job.commands.push_back(as_task(words, job.folder, task.name));
        job.plan.tasks.push_back(std::move(task));
    }
    job.plan.results = outputs.films;
    if (!outputs.films.empty()) {
        job.last = as_task(common, job.folder, k_last_task);
        for (const fs::path& film : outputs.films) job.last.push_back("--output=" + film.string());
        job.last.push_back(frames_word(numbers.front(), numbers.back()));
    }
    return job;
}
