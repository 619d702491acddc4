#pragma once

#include "candela/image.h"

/// Reads a PNG file of any kind, by libpng: its first three channels, or its grey; neither gamma nor
/// transparency is applied. Throws std::runtime_error.
void read_png(const char* path, candela::PictureSink& sink);
