// The option of verbs that show luminances.
#pragma once

#include "aov/luminance.h"
#include "cli/command_line.h"

/// Adds --luminance-scale.
void add_luminance_option(CommandLine& line);

/// Its value, if given. Throws candela::Error (bad_request).
LuminanceDisplay luminance_display_from(const CommandLine& line);
