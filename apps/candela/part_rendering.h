// Pictures that are rendered a band of rows at a time: into the file, or as one part of it.
#pragma once

#include "command_line.h"
#include "stopwatch.h"

import candela.files;
import candela.film;
import candela.registry;
import candela.render;
import candela.scene;

/// Whether the picture is so large that it should not be in memory, and the format does not ask for that.
bool is_streamed(const candela::ImageSettings& image, const candela::PictureFormat& format,
                 candela::Registry& registry);

/// Renders a picture into the file that --output names, in memory for some bands. Returns the exit code.
int render_by_rows(const CommandLine& line, const candela::CompiledScene& scene,
                   const candela::PictureFormat& format, candela::Existing existing,
                   candela::Registry& registry, const Stopwatch& total);

/// Renders the part that --part names. Returns the exit code.
int render_part(const CommandLine& line);
