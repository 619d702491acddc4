// Which differences a person would see.
#pragma once

#include <cstddef>

#include "picture_comparison/picture.h"

/// How many pixels differ so that a person would see it, by Yee's metric: "A perceptual metric for production
/// testing", Journal of Graphics Tools 9(4), 2004. The pictures, of one size, are thought to be on a display
/// of 100 cd/m² and 45 degrees wide. Whole numbers are decoded as sRGB; floats are linear, 1 being the
/// display's white.
std::size_t perceptible_pixels(const Picture& a, const Picture& b);
