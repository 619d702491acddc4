// A square that a small picture covers, texel by pixel.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

#include "golden/image.h"

/// A square of two metres in the plane z = 0 that faces the observer, covered once by the picture.
inline constexpr const char* k_square =
    "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\nvn 0 0 1\n"
    "f 1/1/1 2/2/1 3/3/1\nf 1/1/1 3/3/1 4/4/1\n";

inline constexpr int k_size = 8;

/// Red grows to the right, green downwards, blue is constant: 4, 12 and 100 of 255 per texel.
inline std::string picture() {
    std::string text = fmt::format("P6\n{0} {0}\n255\n", k_size);
    for (int y = 0; y < k_size; ++y) {
        for (int x = 0; x < k_size; ++x)
            for (const int value : {4 * x, 12 * y, 100}) text += static_cast<char>(value);
    }
    return text;
}
inline double red(int x) { return 4.0 * x / 255; }
inline double green(int y) { return 12.0 * y / 255; }
inline constexpr double k_blue = 100.0 / 255;

/// IEC 61966-2-1.
inline double decoded(double c) { return c <= 0.04045 ? c / 12.92 : std::pow((c + 0.055) / 1.055, 2.4); }

/// Like require_pixels(), where a texel is looked up for each pixel.
template <class Expected>
void require_texels(const Image& image, Expected expected) {
    require_pixels(image, expected, 3e-4);
}
