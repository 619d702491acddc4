#include "compare/differences.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace {

/// Exact for whole numbers, so that a tolerance of 3 levels tolerates 3 levels.
double difference(const Image& a, const Image& b, std::size_t i) {
    constexpr double k_levels = 255;
    if (a.is_float || b.is_float)
        return k_levels *
               std::abs(static_cast<double>(a.normalized(i)) - static_cast<double>(b.normalized(i)));
    return k_levels * std::abs(static_cast<double>(a.values[i]) - static_cast<double>(b.values[i])) /
           static_cast<double>(Image::k_whole);
}

bool is_white(const Image& mask, std::size_t pixel) {
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        if (mask.normalized(i) <= 0.5f) return false;
    }
    return true;
}

/// Until the end, `mean` and `rmse` are sums of the differences and of their squares.
void add(DifferenceStatistics& statistics, const Image& a, const Image& b, std::size_t pixel,
         double tolerance) {
    double largest = 0;
    for (std::size_t i = 3 * pixel; i < 3 * pixel + 3; ++i) {
        const double levels = difference(a, b, i);
        largest = std::max(largest, levels);
        statistics.mean += levels;
        statistics.rmse += levels * levels;
    }
    ++statistics.pixels;
    if (largest == 0) ++statistics.identical;
    if (largest > tolerance) ++statistics.beyond;
    if (largest <= statistics.maximum) return;
    statistics.maximum = largest;
    statistics.x = static_cast<int>(pixel % static_cast<std::size_t>(a.width));
    statistics.y = static_cast<int>(pixel / static_cast<std::size_t>(a.width));
}

void finish(DifferenceStatistics& statistics) {
    if (statistics.pixels == 0) return;
    const double channels = 3 * static_cast<double>(statistics.pixels);
    statistics.mean /= channels;
    statistics.rmse = std::sqrt(statistics.rmse / channels);
}

}  // namespace

double DifferenceStatistics::identical_share() const {
    return pixels == 0 ? 1 : static_cast<double>(identical) / static_cast<double>(pixels);
}

std::optional<double> DifferenceStatistics::psnr() const {
    if (rmse == 0) return std::nullopt;
    return 20 * std::log10(255 / rmse);
}

double largest_difference(const Image& a, const Image& b, std::size_t pixel) {
    return std::max(
        {difference(a, b, 3 * pixel), difference(a, b, 3 * pixel + 1), difference(a, b, 3 * pixel + 2)});
}

Differences compare(const Image& a, const Image& b, const Image* mask, double tolerance) {
    Differences result;
    if (mask != nullptr) result.edges.emplace();
    for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) {
        DifferenceStatistics& statistics =
            mask != nullptr && is_white(*mask, pixel) ? *result.edges : result.interior;
        add(statistics, a, b, pixel, tolerance);
    }
    finish(result.interior);
    if (result.edges) finish(*result.edges);
    return result;
}
