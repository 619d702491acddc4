// Pictures that a model names or contains, before a scene relies on them: whether they can be read, and what
// their pixels say.
#pragma once

#include <array>
#include <string>

#include "import/model.h"

import candela.formats;
import candela.registry;

namespace importing {

/// A picture as a scene will read it.
struct ReadPicture {
    candela::DecodedPicture pixels;
    /// The format that its content tells, where its name says another: "jpg"; otherwise empty.
    std::string other_format{};
};

/// Reads a picture, whether it is a file or bytes of one. Throws candela::Error (failure) with the reason if
/// none can be made of it: no image plugin reads its format, it is empty, it is cut off. A scene that has it
/// would be refused.
ReadPicture read_picture(const Picture& picture, candela::Registry& registry);

/// The mean over the pixels of their largest channel: 0 to 1, linear.
double brightness_of(const candela::DecodedPicture& picture);

/// Means of a picture's channels, 0 to 1.
struct Means {
    std::array<double, 3> stored{};  // as they are in the file
    std::array<double, 3> linear{};  // of intensities
    double opacity = 1;
};

Means means_of(const candela::DecodedPicture& picture);

/// How opaque a picture is, in at most a few hundred rows and columns.
struct OpacityMap {
    int width = 0, height = 0;
    std::string bytes{};        // 255: opaque; empty: all of it is
    bool is_clear_cut = false;  // some pixels are opaque, some transparent, and few are neither

    /// Whether all of it is at least `level`; and whether some is, and some is not.
    bool is_all(double level) const;
    bool is_cut_by(double level) const;
    /// As a binary greymap.
    std::string pgm() const;
};

OpacityMap opacity_of(const candela::DecodedPicture& picture);

}  // namespace importing
