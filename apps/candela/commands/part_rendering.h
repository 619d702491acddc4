// One of the parts of a picture that are rendered separately.
#pragma once

#include "cli/command_line.h"

/// Renders the part that --part names. Returns the exit code.
int render_part(const CommandLine& line);
