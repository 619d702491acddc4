#include "origin.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "mesh_io/text_scanner.h"

namespace mesh {

namespace {

/// Rounds to a power of ten of at most `size`, for a short number.
double short_number(double x, double size) {
    const double power = std::floor(std::log10(size)), step = std::pow(10.0, std::abs(power));
    return power < 0 ? std::round(x * step) / step : std::round(x / step) * step;
}

}  // namespace

std::optional<mesh_io::Origin> origin_from(std::string_view text) {
    mesh_io::Origin origin;
    std::string words(text);
    std::ranges::replace(words, ',', ' ');
    mesh_io::TextScanner scanner(words);
    std::string_view word = scanner.word();
    if (word.empty()) return origin;
    for (double& x : origin.at) {
        const auto number = mesh_io::number_from(word);
        if (!number || !std::isfinite(*number)) return std::nullopt;
        x = *number;
        word = scanner.word();
    }
    return word.empty() ? std::optional(origin) : std::nullopt;
}

std::string too_far_note(const mesh_io::Surface& surface, const mesh_io::Origin& origin) {
    std::array<double, 3> center{};
    double size = 0, farthest = 0, farthest_in_file = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) {
        const mesh_io::Array<float>& values = axis == 0   ? surface.position.x
                                              : axis == 1 ? surface.position.y
                                                          : surface.position.z;
        if (values.empty()) return {};
        const auto [low, high] = std::ranges::minmax(values);
        center[axis] = 0.5 * (double{low} + double{high});
        size = std::max(size, double{high} - double{low});
        for (const double x : {double{low}, double{high}}) {
            farthest = std::max(farthest, std::abs(x));
            farthest_in_file = std::max(farthest_in_file, std::abs(x + origin.at[axis]));
        }
    }
    // At this distance the error is 0.06 pixels in a picture a thousand pixels wide.
    constexpr double k_too_far = 1e3;
    if (!std::isfinite(farthest) || size == 0) return {};
    const auto step = [](double x) {
        return std::exp2(std::floor(std::log2(x))) * double{std::numeric_limits<float>::epsilon()};
    };
    if (surface.is_single && farthest_in_file > k_too_far * size)
        return fmt::format(
            "stores its coordinates in single precision, which rounds them to {:.2g} m so far from the "
            "origin; the file itself has lost its shape",
            step(farthest_in_file));
    if (!(farthest > k_too_far * size)) return {};
    return fmt::format(
        "lies so far from the origin that its coordinates are rounded to {:.2g} m; set origin = \"{} {} {}\" "
        "to move it before rounding",
        step(farthest), origin.at[0] + short_number(center[0], size),
        origin.at[1] + short_number(center[1], size), origin.at[2] + short_number(center[2], size));
}

}  // namespace mesh
