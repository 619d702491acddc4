// How two pictures differ.
#pragma once

#include <cstdint>
#include <filesystem>

namespace verify {

/// Figures of a set of pixels; differences in levels of 1/255, the largest and the mean of all channels.
struct Figures {
    std::uint64_t pixels = 0;
    std::uint64_t identical = 0;
    double maximum = 0;
    double mean = 0;
};

struct Comparison {
    Figures interior, edges;
    std::uint64_t perceptible = 0;  // pixels whose difference a person would see (Yee 2004), of all
};

/// What `candela diff` says of two pictures, pixels apart that are white in `edges`; writes the picture of
/// the differences to `heat_map`. `program`: the program behind that verb. Throws candela::Error.
Comparison compare(const std::filesystem::path& program, const std::filesystem::path& a,
                   const std::filesystem::path& b, const std::filesystem::path& edges,
                   const std::filesystem::path& heat_map);

}  // namespace verify
