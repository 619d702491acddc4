// Pictures from files.
#pragma once

#include <filesystem>

#include "picture_comparison/picture.h"

import candela.diagnostics;
import candela.registry;

/// Reads a picture of any format that OpenImageIO knows, or else an image plugin; alpha is left out, and grey
/// becomes red, green and blue alike. Throws candela::Error (failure) for what is no picture, or holds what
/// is no finite number.
Picture read_picture(const std::filesystem::path& file, candela::Registry& registry);
