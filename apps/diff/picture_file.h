// Pictures from files.
#pragma once

#include <filesystem>

#include "picture_comparison/picture.h"

import candela.diagnostics;

/// Reads a picture of any format that OpenImageIO knows; alpha is left out, and grey becomes red, green and
/// blue alike. Throws candela::Error (failure) for what is no picture, or holds what is no finite number.
Picture read_picture(const std::filesystem::path& file);
