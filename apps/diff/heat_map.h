// A picture of where two pictures differ.
#pragma once

#include <filesystem>

#include "picture_comparison/picture.h"

import candela.diagnostics;
import candela.files;

/// Throws candela::Error (usage) where `file` does not end in a format that a heat-map can be written in.
void require_heat_map_format(const std::filesystem::path& file);

/// Writes the largest channel difference of each pixel as a colour, from black, no difference, to
/// white-hot, `maximum` levels; 8-bit RGB, whole or not there. `existing`: what becomes of a file of that
/// name. Throws candela::Error.
void write_heat_map(const std::filesystem::path& file, const Picture& a, const Picture& b, double maximum,
                    candela::Existing existing);
