// Pictures that a model names or contains, before a scene relies on them: whether they can be read, and
// properties of their pixels.
#pragma once

#include <array>
#include <string>

#include "import/model.h"

import candela.plugins;

namespace importing {

/// A picture as a scene will read it.
struct ReadImage {
    candela::DecodedImage pixels;
    /// The format of its content if its name says another: "jpg"; otherwise empty.
    std::string other_format{};
};

/// Reads a picture from a file or from its bytes. Throws candela::Error (failure) with the reason if that
/// fails: no image plugin reads its format, or it is empty or truncated. A scene that uses such a picture
/// would be rejected. Any thread.
ReadImage read_image(const Image& image, candela::Registry& registry);

/// The mean over all pixels of the largest channel: 0 to 1, linear.
double brightness_of(const candela::DecodedImage& image);

/// Means of a picture's channels, 0 to 1.
struct Means {
    std::array<double, 3> stored{};  // as stored in the file
    std::array<double, 3> linear{};  // of linear intensities
    double opacity = 1;
    // Whether all pixels have the mean:
    std::array<bool, 3> are_equal{};
    bool is_opacity_equal = true;
};

Means means_of(const candela::DecodedImage& image);

}  // namespace importing
