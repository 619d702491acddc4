#pragma once

#include "candela/image_format.h"

/// Reads a PNG file of any kind with libpng: its first three channels, or its grey channel. Applies neither
/// gamma nor transparency. Throws std::runtime_error.
void read_png(const char* path, candela::ImageSink& sink);
