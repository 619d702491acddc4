// Binary PPM files that the command writes.
#pragma once

#include <array>
#include <filesystem>
#include <string>

/// A picture of eight bits per channel.
struct Ppm {
    int width = 0, height = 0;
    std::string bytes;  // red, green and blue, row by row from the top

    std::array<int, 3> at(int x, int y) const;
    std::array<int, 3> middle() const { return at(width / 2, height / 2); }
    /// The bytes of a rectangle.
    std::string part(int x, int y, int across, int down) const;
    /// Whether the outermost pixels all have the same colour.
    bool has_free_border() const;
    /// The share of pixels that differ from the first, the background.
    double covered() const;
    /// The share of white among the pixels that differ from the first.
    double burnt() const;
};

/// Fails the test if it is not such a file.
Ppm read_ppm(const std::filesystem::path& file);

/// The largest difference of two pictures of the same size, in levels.
int largest_difference(const Ppm& a, const Ppm& b);
