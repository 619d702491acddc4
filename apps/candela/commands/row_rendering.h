// Pictures rendered a band of rows at a time.
#pragma once

#include "cli/command_line.h"
#include "console/stopwatch.h"

import candela.plugins;
import candela.render;
import candela.scene;
import candela.util;

/// Whether the picture is too large to keep in memory and the format does not require that.
bool is_streamed(const candela::ImageSettings& image, const candela::OutputFormat& format,
                 candela::Registry& registry);

/// Renders a picture into the file that --output names, with only some bands in memory. Returns the exit
/// code.
int render_by_rows(const CommandLine& line, const candela::RenderScene& scene,
                   const candela::OutputFormat& format, candela::Existing existing,
                   candela::Registry& registry, const Stopwatch& total);
