// Finds visible differences.
#pragma once

#include <cstddef>

#include "compare/image.h"

/// The number of pixels that differ visibly, by Yee's metric: "A perceptual metric for production testing",
/// Journal of Graphics Tools 9(4), 2004. Assumes that the pictures, which have one size, are on a display of
/// 100 cd/m² that is 45 degrees wide. Whole numbers are decoded as sRGB; floats are linear, with 1 as the
/// display's white.
std::size_t perceptible_pixels(const Image& a, const Image& b);
