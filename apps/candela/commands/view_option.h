// --view, --display and --color-config: pictures through a view of OpenColorIO.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "cli/command_line.h"
#include "color_view/color_view.h"

import candela.render;

void add_view_options(CommandLine& line);

/// The view that the options name; nothing without them.
std::optional<ViewName> view_name_from(const CommandLine& line);

/// The arguments that give another command the view.
std::vector<std::string> view_words_from(const CommandLine& line, const ColorView& view);

/// That view, already searched for; null without one. Throws candela::Error if files of the format have
/// intensities.
std::unique_ptr<ColorView> view_from(const CommandLine& line, const candela::OutputFormat& format);
