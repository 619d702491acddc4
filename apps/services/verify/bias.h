// Finds errors that are small but everywhere, so that no single pixel shows them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <vector>

#include "verify/edges.h"

import candela.api;
import candela.util;

namespace verify {

/// Candela's picture and its known properties. Rows from the top, without padding.
struct Expectation {
    int width = 0, height = 0;
    candela::ColorEncoding encoding = candela::ColorEncoding::srgb;
    std::vector<float> levels;  // red, green, blue before rounding, 0 to 255
    Sensitivity sensitivity;
    std::vector<bool> shown;  // one per pixel: whether it shows more than the background

    std::size_t pixels() const { return shown.size(); }
};

/// A figure that is 0, except for noise, if a program is correct.
struct Estimate {
    double value = 0;
    double deviations = 0;  // |value| as a multiple of its standard error
};

/// The pixels that a verdict is based on, and what their differences have in common. A program with correct
/// formulas computes what Candela computes except for the last bits of its floats. It therefore rounds to the
/// same level, except where Candela's own value is within a hundredth of a level of the rounding threshold.
/// Such values are left out. The others should not differ at all, and common differences are errors of the
/// program, however small. Edges and background are also left out.
struct Bias {
    std::size_t shown = 0;     // pixels that show more than the background
    std::size_t interior = 0;  // those that are away from edges

    // The combination that explains the differences best, by least squares:
    Estimate gain{};           // the program's intensities are Candela's times 1 + gain
    Estimate right{}, down{};  // displacement of its picture in pixels
    Estimate zoom{};           // enlargement of its picture: the factor minus 1

    /// The mean remaining difference, in levels, of the 16 x 16 pixels where it is farthest from 0.
    Estimate region{};
    int region_x = 0, region_y = 0;
};

/// `program`: red, green and blue of the program's picture, which has the expectation's size.
Bias bias_of(const Expectation& expected, const std::vector<std::uint8_t>& program);

struct RgbImage {
    int width = 0, height = 0;
    std::vector<std::uint8_t> bytes;
};

/// Reads a binary 8-bit PPM file (P6) as candela-diff writes it, without comments. Throws candela::Error.
RgbImage read_ppm(const std::filesystem::path& file);

}  // namespace verify
