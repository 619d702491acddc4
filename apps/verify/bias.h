// What a program does a little wrong everywhere, which no single pixel shows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "verify/edges.h"

import candela.color;
import candela.diagnostics;

namespace verify {

/// Candela's picture, and what is known about it. Rows from the top, no padding.
struct Expectation {
    int width = 0, height = 0;
    candela::ColorEncoding encoding = candela::ColorEncoding::srgb;
    std::vector<float> levels;  // red, green, blue before rounding, 0 to 255
    Sensitivity sensitivity;
    std::vector<bool> shown;  // a pixel each: whether it shows more than the background

    std::size_t pixels() const { return shown.size(); }
};

/// A figure that is 0 where a program is right, but for noise.
struct Estimate {
    double value = 0;
    double deviations = 0;  // |value| as a multiple of its standard error
};

/// The pixels that a verdict rests on, and what their differences have in common. A program with correct
/// formulas computes what Candela computes but for the last bits of its floats, so it rounds to the same
/// level except where Candela's own value lies within a hundredth of a level of being rounded the other way.
/// Such values are left out; what remains should not differ at all, and differences that have something in
/// common are errors of the program, however small. Edges and background are left out as well.
struct Bias {
    std::size_t shown = 0;     // pixels that show more than the background
    std::size_t interior = 0;  // those of them that are away from edges

    // What explains the differences best, all together, by least squares:
    Estimate gain{};           // the program's intensities are Candela's times 1 + gain
    Estimate right{}, down{};  // pixels that its picture is displaced
    Estimate zoom{};           // its picture is larger by this factor less 1
    Estimate roll{};           // radians that its picture is turned, clockwise

    /// What they leave: the mean difference in levels of the 16 x 16 pixels where it is farthest from 0.
    Estimate region{};
    int region_x = 0, region_y = 0;
};

/// `program`: red, green and blue of the program's picture, as large as the expectation's.
Bias bias_of(const Expectation& expected, const std::vector<std::uint8_t>& program);

struct RgbPicture {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
};

/// Reads a binary PPM file (P6) of 8 bits as candela-diff writes it, without comments. Throws candela::Error.
RgbPicture read_ppm(const std::filesystem::path& file);

}  // namespace verify
