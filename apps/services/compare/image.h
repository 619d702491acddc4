// A picture for comparison: red, green and blue in the file's own numbers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

/// Rows from the top, without padding. Black outside the part that the file stores.
struct Image {
    int width = 0;
    int height = 0;
    bool is_float = false;  // as computed; otherwise whole numbers, encoded for a display
    std::vector<float>
        values;  // red, green, blue; whole numbers scaled to 0 to 65535, which represents all of them
    static constexpr float k_whole = 65535;

    std::size_t pixels() const { return static_cast<std::size_t>(width) * static_cast<std::size_t>(height); }
    /// The `i`-th value, with 1 for the largest integer.
    float normalized(std::size_t i) const { return is_float ? values[i] : values[i] / k_whole; }
};

/// "640 x 480"
std::string dimensions_text(const Image& image);
