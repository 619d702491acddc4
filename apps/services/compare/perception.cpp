// Does not use ImageBufAlgo::compare_Yee of OpenImageIO: it reads its luminances from a nonexistent channel
// (2.4.7), and so takes black and white for equal.
#include "compare/perception.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <vector>

import candela.util;

namespace {

constexpr double k_white = 100;     // cd/m²
constexpr double k_degrees = 45;    // from the left edge of the picture to the right
constexpr double k_darkest = 1e-5;  // cd/m²; invisible below
constexpr std::size_t k_bands = 6;
constexpr std::size_t k_levels = k_bands + 2;

/// The smallest visible difference of luminance, in cd/m², for a luminance of the surroundings. Ward Larson,
/// Rushmeier and Piatko (1997), A visibility matching tone reproduction operator, table 1.
double threshold(double luminance) {
    const double l = std::log10(luminance);
    const auto log_threshold = [&] {
        if (l < -3.94) return -2.86;
        if (l < -1.44) return std::pow(0.405 * l + 1.6, 2.18) - 2.86;
        if (l < -0.0184) return l - 0.395;
        if (l < 1.9) return std::pow(0.249 * l + 0.65, 2.7) - 0.72;
        return l - 1.255;
    };
    return std::pow(10.0, log_threshold());
}

/// How visible a grating is with that many cycles per degree. Barten (1989), The square root integral.
double sensitivity(double cycles, double luminance) {
    const double a = 440 * std::pow(1 + 0.7 / luminance, -0.2);
    const double b = 0.3 * std::pow(1 + 100 / luminance, 0.15);
    return a * cycles * std::exp(-b * cycles) * std::sqrt(1 + 0.06 * std::exp(b * cycles));
}

/// How strongly a texture masks additions to it. Daly (1993), The visible differences predictor.
double masking(double contrast) {
    const double a = std::pow(392.498 * contrast, 0.7);
    return std::pow(1 + std::pow(0.0153 * a, 4.0), 0.25);
}

double linear(const Image& image, std::size_t i) {
    constexpr float k_brightest = 1e6f;
    const double value = std::clamp(image.normalized(i), 0.0f, k_brightest);
    if (image.is_float) return value;
    return value <= 0.04045 ? value / 12.92 : std::pow((value + 0.055) / 1.055, 2.4);
}

struct Color {
    double luminance = 0;  // cd/m²
    double a = 0, b = 0;   // of CIE L*a*b*
};

/// CIE 15: XYZ of sRGB (IEC 61966-2-1), relative to its white, and L*a*b*.
Color color_at(const Image& image, std::size_t pixel) {
    const double red = linear(image, 3 * pixel), green = linear(image, 3 * pixel + 1),
                 blue = linear(image, 3 * pixel + 2);
    const double x = (0.4124 * red + 0.3576 * green + 0.1805 * blue) / 0.9505;
    const double y = 0.2126 * red + 0.7152 * green + 0.0722 * blue;
    const double z = (0.0193 * red + 0.1192 * green + 0.9505 * blue) / 1.0890;
    const auto f = [](double t) {
        return t > 216.0 / 24389.0 ? std::cbrt(t) : (24389.0 / 27.0 * t + 16) / 116;
    };
    return {.luminance = k_white * y, .a = 500 * (f(x) - f(y)), .b = 200 * (f(y) - f(z))};
}

/// Luminances in levels, each with half the frequencies of the one before: Burt and Adelson (1983), The
/// Laplacian pyramid, but with all levels as large as the picture.
class Pyramid {
  public:
    explicit Pyramid(const Image& image)
        : width_(static_cast<std::size_t>(image.width)), height_(static_cast<std::size_t>(image.height)) {
        levels_[0].resize(image.pixels());
        for (std::size_t i = 0; i < image.pixels(); ++i)
            levels_[0][i] = static_cast<float>(color_at(image, i).luminance);
        for (std::size_t level = 1; level < k_levels; ++level)
            levels_[level] = blurred(levels_[level - 1], std::size_t{1} << (level - 1));
    }

    double at(std::size_t level, std::size_t pixel) const { return levels_[level][pixel]; }

  private:
    using Plane = std::vector<float>;

    /// Five weights, `step` apart; the border pixels are repeated beyond the border.
    Plane blurred(const Plane& plane, std::size_t step) const {
        constexpr std::array<float, 5> k_weights = {0.05f, 0.25f, 0.4f, 0.25f, 0.05f};
        Plane across(plane.size()), result(plane.size());
        std::vector<float> padded(width_ + 4 * step);
        for (std::size_t y = 0; y < height_; ++y) {
            const float* const row = &plane[y * width_];
            for (std::size_t i = 0; i < padded.size(); ++i)
                padded[i] = row[std::clamp(i, 2 * step, 2 * step + width_ - 1) - 2 * step];
            for (std::size_t k = 0; k < k_weights.size(); ++k) {
                for (std::size_t x = 0; x < width_; ++x)
                    across[y * width_ + x] += k_weights[k] * padded[x + k * step];
            }
        }
        for (std::size_t y = 0; y < height_; ++y) {
            for (std::size_t k = 0; k < k_weights.size(); ++k) {
                const std::size_t from =
                    std::clamp(y + k * step, 2 * step, 2 * step + height_ - 1) - 2 * step;
                for (std::size_t x = 0; x < width_; ++x)
                    result[y * width_ + x] += k_weights[k] * across[from * width_ + x];
            }
        }
        return result;
    }

    std::size_t width_, height_;
    std::array<Plane, k_levels> levels_;
};

class Metric {
  public:
    Metric(const Image& a, const Image& b) : a_(a), b_(b), of_a_(a), of_b_(b) {
        const double pixels_a_degree =
            a.width / (2 * std::tan(k_degrees / 2 * std::numbers::pi / 180) * 180 / std::numbers::pi);
        // The eye adapts to about one degree.
        while (adaptation_ + 1 < k_levels && std::exp2(adaptation_ + 1) <= pixels_a_degree) ++adaptation_;
        for (std::size_t i = 0; i < k_bands; ++i) {
            cycles_[i] = pixels_a_degree / std::exp2(i + 1);
            weights_[i] = sensitivity(3.248, k_white) / sensitivity(cycles_[i], k_white);
        }
    }

    bool is_seen(std::size_t pixel) const {
        constexpr double k_photopic = 10;  // cd/m²; below it, colours fade
        const Color a = color_at(a_, pixel), b = color_at(b_, pixel);
        const double around =
            std::max((of_a_.at(adaptation_, pixel) + of_b_.at(adaptation_, pixel)) / 2, k_darkest);
        const double luminance = std::abs(a.luminance - b.luminance) / threshold(around);
        const double fading = std::min(around / k_photopic, 1.0);
        const double color = ((a.a - b.a) * (a.a - b.a) + (a.b - b.b) * (a.b - b.b)) * fading * fading;
        const double difference = std::max(luminance, color);
        // Masking never lowers the threshold, and raises it at most tenfold.
        return difference > 1 && (difference > 10 || difference > elevation(pixel, around));
    }

  private:
    /// The factor by which the surroundings raise the threshold: 1 to 10.
    double elevation(std::size_t pixel, double around) const {
        double sum = 0, contrasts = 0;
        for (std::size_t i = 0; i < k_bands; ++i) {
            const auto band = [&](const Pyramid& p) { return std::abs(p.at(i, pixel) - p.at(i + 1, pixel)); };
            const double contrast = std::max(band(of_a_), band(of_b_)) /
                                    std::max({of_a_.at(i + 2, pixel), of_b_.at(i + 2, pixel), k_darkest});
            contrasts += contrast;
            sum += contrast * weights_[i] * masking(contrast * sensitivity(cycles_[i], around));
        }
        return std::clamp(sum / std::max(contrasts, 1e-5), 1.0, 10.0);
    }

    const Image& a_;
    const Image& b_;
    Pyramid of_a_, of_b_;
    std::size_t adaptation_ = 0;
    std::array<double, k_bands> cycles_{}, weights_{};
};

}  // namespace

std::size_t perceptible_pixels(const Image& a, const Image& b) {
    if (a.is_float == b.is_float && a.values == b.values) return 0;
    const std::uint64_t planes = 2 * k_levels + 1;
    candela::require_memory(sizeof(float) * planes * a.pixels(),
                            fmt::format("comparing pictures of {} pixels", dimensions_text(a)));
    const Metric metric(a, b);
    std::size_t seen = 0;
    for (std::size_t pixel = 0; pixel < a.pixels(); ++pixel) seen += metric.is_seen(pixel) ? 1 : 0;
    return seen;
}
