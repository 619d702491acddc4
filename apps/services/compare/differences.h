// Measures how much two pictures differ, in levels (1/255).
#pragma once

#include <cstddef>
#include <optional>

#include "compare/image.h"

/// Statistics of some of the pixels; differences in levels, over all channels.
struct DifferenceStatistics {
    std::size_t pixels = 0;
    std::size_t identical = 0;  // equal in all channels
    std::size_t beyond = 0;     // with a channel that differs by more than the tolerance
    double maximum = 0;
    int x = 0, y = 0;  // the first pixel that differs by the maximum
    double mean = 0;
    double rmse = 0;

    /// 0 to 1; 1 if there are no pixels.
    double identical_share() const;
    /// 20 log10(255 / rmse) in dB; nothing if nothing differs.
    std::optional<double> psnr() const;
};

struct Differences {
    DifferenceStatistics interior;
    std::optional<DifferenceStatistics> edges;  // with a mask
};

/// The largest difference among the channels of the `pixel`-th pixel, in levels.
double largest_difference(const Image& a, const Image& b, std::size_t pixel);

/// The statistics of two pictures of one size. White pixels in `mask` (all channels above 1/2), which has the
/// same size or is null, are edges. `beyond` counts differences larger than `tolerance` levels.
Differences compare(const Image& a, const Image& b, const Image* mask, double tolerance);
