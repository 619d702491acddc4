// The parts of a picture as tasks.
#include <fmt/format.h>

#include <filesystem>
#include <string>
#include <vector>

#include "cli/output_format.h"
#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "commands/submission/job_submission.h"
#include "commands/view_option.h"
#include "jobs/image_parts.h"

import candela.render;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;

namespace {

/// The picture that --output names.
fs::path image_from(const CommandLine& line) {
    const std::vector<std::string> outputs = line.all("output");
    if (outputs.size() != 1 || outputs.front() == "-")
        throw Error(ErrorCategory::bad_request,
                    "--parts applies to one picture; name it with -o, such as -o poster.tif");
    for (const char* const option : {"frames", "chunk"}) {
        if (line.has(option))
            throw Error(ErrorCategory::bad_request,
                        fmt::format("--{} applies to frames, but --parts to one picture", option));
    }
    return outputs.front();
}

}  // namespace

std::optional<Submission> submission_of_parts(const CommandLine& line, int threads,
                                              candela::Diagnostics& diagnostics) {
    const fs::path picture = image_from(line);
    if (view_name_from(line))
        throw Error(ErrorCategory::bad_request,
                    "--view and --parts cannot be combined: a view applies to the whole picture");
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = output_format_from(line, picture, registry);
    bool has_asked = false;
    const auto draft =
        candela::draft_scene(repeatable_request_from(line, registry, has_asked), registry, diagnostics);
    // Some errors show only in the triangles; each task compiles the scene again.
    if (!draft || !compile_scene(*draft, registry, diagnostics)) return std::nullopt;
    require_no_scene_file(picture.string(), candela::input_files(*draft), "the picture");

    const int parts = count_from(line, "parts", 1'000'000);
    const PartedImage parted = parted_image_of(*draft, format, parts, registry);
    Submission job{.plan = {},
                   .folder = JobFolder::of_output(picture),
                   .commands = {},
                   .last = {},
                   .open = {},
                   .queue_options = {}};
    job.plan.output = picture.string();
    job.plan.whole = {picture, parted.inputs};
    job.plan.results = {picture};
    Words common = common_words(line, "render", has_asked);
    common.push_back("--output=" + picture.string());
    if (line.has("frame")) common.push_back(fmt::format("--frame={}", line.get<int>("frame")));
    common.push_back(fmt::format("--threads={}", threads));
    for (int i = 1; i <= parts; ++i) {
        const PartNumber part{i, parts};
        static_cast<void>(
            rows_of(part, draft->scene.image.height));  // checks that the picture has enough rows
        job.plan.tasks.push_back({part.name(), {{file_of_part(picture, part), parted.inputs_of_parts()}}});
        job.commands.push_back(as_task(common, job.folder, part.name()));
        job.commands.back().push_back(fmt::format("--part={}/{}", i, parts));
    }
    job.last = as_task({common.front(), "assemble", picture.string(), "--quiet"}, job.folder, k_last_task);
    for (const std::string& word : format_words_from(line)) job.last.push_back(word);
    for (const std::string& folder : line.all("plugin-dir")) job.last.push_back("--plugin-dir=" + folder);
    if (line.has("allow-untrusted-plugins")) job.last.emplace_back("--allow-untrusted-plugins");
    return job;
}
