#include "commands/part_rendering.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <span>
#include <string>

#include "cli/output_format.h"
#include "cli/outputs.h"
#include "cli/scene_compilation.h"
#include "console/exit_code.h"
#include "console/reporting.h"
#include "console/stopwatch.h"
#include "console/terminal.h"
#include "film/render_cache.h"
#include "jobs/image_parts.h"
#include "render/rendered_rows.h"

import candela.api;
import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

namespace fs = std::filesystem;
using candela::Error;
using candela::ErrorCategory;
using candela::Links;

namespace {

void write_pixels(candela::RenderedRows& rows, int count, const fs::path& path) {
    candela::OutputFile file(path, candela::Existing::replaced, Links::not_followed);
    constexpr int k_at_once = 64;
    for (int y = 0; y < count; y += k_at_once) {
        const candela::ImageView some = rows.next(k_at_once);
        file.write(some.pixels == candela::PixelType::byte ? std::as_bytes(some.bytes)
                                                           : std::as_bytes(some.reals));
    }
    file.finish();
}

void require_no(const CommandLine& line, const char* option, const char* why) {
    if (line.has(option))
        throw Error(ErrorCategory::bad_request,
                    fmt::format("--{} and --part cannot be combined: {}", option, why));
}

}  // namespace

int render_part(const CommandLine& line) {
    const Stopwatch total;
    const PartNumber part = part_from(line.get<std::string>("part"));
    const auto output = line.get<std::string>("output");
    if (output == "-")
        throw Error(ErrorCategory::bad_request, "parts are files next to the picture; name it with -o");
    for (const char* const option : {"view", "display", "color-config"})
        require_no(line, option, "a view applies to the whole picture");
    require_no(line, "terms", "parts hold only the picture");
    require_no(line, "no-clobber", "a part that is up to date is kept anyway");
    const int threads = threads_from(line);
    candela::Registry registry = registry_from(line);
    const candela::OutputFormat format = output_format_from(line, output, registry);
    candela::Diagnostics diagnostics;
    const auto draft = candela::draft_scene(scene_request_from(line, registry), registry, diagnostics);
    if (draft) {
        require_no_scene_file(output, candela::input_files(*draft), "the picture");
    }
    const auto scene = draft ? compile_scene(*draft, registry, diagnostics, threads) : std::nullopt;
    report(diagnostics);
    if (!scene) return static_cast<int>(exit_code_of(diagnostics));

    const candela::RowRange range = rows_of(part, scene->image.height);
    const PartedImage parted = parted_image_of(*draft, format, part.of, registry);
    const fs::path file = file_of_part(output, part);
    const char* is_done = nullptr;
    if (recorded(output, parted.inputs, Links::followed) == CacheState::made) {
        is_done = "the picture is already complete";
    } else {
        write_description(parted, output);
        if (is_up_to_date(file, parted.inputs_of_parts(), Links::not_followed))
            is_done = "already up to date";
    }
    if (is_done == nullptr) {
        ProgressBar bar("rendering", !is_quiet());
        candela::RenderedRows rows(*scene, format.pixels, range,
                                   {.threads = threads, .progress = bar.updater()});
        write_pixels(rows, range.end - range.first, file);
        record(file, parted.inputs_of_parts(), Links::not_followed);
    }
    say_afterwards([&] {
        return fmt::format("{}: part {} of {}, rows {} to {}, {}\n", output, part.number, part.of,
                           range.first, range.end - 1,
                           is_done != nullptr ? is_done : duration_text(total.milliseconds()));
    });
    return 0;
}
