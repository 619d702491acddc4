// Reads pictures from files.
#pragma once

#include <filesystem>

#include "compare/image.h"

import candela.plugins;
import candela.util;

/// Reads a picture of any format that OpenImageIO or, failing that, an image plugin supports. Drops alpha,
/// and converts grey to equal red, green and blue. Throws candela::Error (failure) if the file is not a
/// picture or contains a non-finite number.
Image read_image(const std::filesystem::path& file, candela::Registry& registry);
