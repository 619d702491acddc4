// Writes a picture of where two pictures differ.
#pragma once

#include <filesystem>

#include "compare/image.h"

import candela.util;

/// Throws candela::Error (usage) if the extension of `file` is not a format for heat-maps.
void require_heat_map_format(const std::filesystem::path& file);

/// Writes the largest channel difference of each pixel as a colour, from black (no difference) to white-hot
/// (`maximum` levels); 8-bit RGB, complete or not at all. `existing`: what to do with an existing file.
/// Throws candela::Error.
void write_heat_map(const std::filesystem::path& file, const Image& a, const Image& b, double maximum,
                    candela::Existing existing);
