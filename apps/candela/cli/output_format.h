// The format of a picture and its parameters.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/command_line.h"

import candela.plugins;
import candela.render;

/// Adds --format-set.
void add_format_option(CommandLine& line);

/// The format for a picture's name, with the parameters that --format-set sets. Throws candela::Error
/// (bad_request) if no plugin writes such pictures, or for invalid parameters.
candela::OutputFormat output_format_from(const CommandLine& line, const std::filesystem::path& image,
                                         candela::Registry& registry);

/// The arguments that give another command the same format.
std::vector<std::string> format_words_from(const CommandLine& line);
