#include "commands/row_rendering.h"

#include <fmt/format.h>

#include <string>

#include "console/reporting.h"
#include "console/terminal.h"
#include "render/rendered_rows.h"

import candela.api;
import candela.util;

namespace {

void warn_if_dark(const candela::RenderedRows& rows) {
    const std::string darkness = rows.darkness_diagnosis();
    if (!darkness.empty()) warn("nothing in the picture is lit: " + darkness);
}

}  // namespace

bool is_streamed(const candela::ImageSettings& image, const candela::OutputFormat& format,
                 candela::Registry& registry) {
    constexpr double k_large = 256e6;  // bytes
    const double size =
        3.0 * image.width * image.height * (format.pixels == candela::PixelType::byte ? 1 : 4);
    return size > k_large && candela::can_write_rows(format, registry);
}

int render_by_rows(const CommandLine& line, const candela::RenderScene& scene,
                   const candela::OutputFormat& format, candela::Existing existing,
                   candela::Registry& registry, const Stopwatch& total) {
    const auto output = line.get<std::string>("output");
    const candela::ImageSettings& image = scene.image;
    const int threads = threads_from(line);
    {
        ProgressBar bar("rendering", !is_quiet());
        candela::RenderedRows rows(scene, format.pixels, {0, image.height},
                                   {.threads = threads, .progress = bar.updater()});
        const candela::ImageView whole{.width = image.width,
                                       .height = image.height,
                                       .pixels = format.pixels,
                                       .encoding = image.color_management};
        candela::with_threads(threads,
                              [&] { candela::write_rows(whole, rows, format, output, registry, existing); });
        warn_if_dark(rows);
    }
    say_afterwards([&] {
        return fmt::format("{}: {} x {}, {}\n", output == "-" ? "picture" : output, image.width, image.height,
                           duration_text(total.milliseconds()));
    });
    return 0;
}
