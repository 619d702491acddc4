#include "median_cut.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace candela::environment_light {

namespace {

constexpr double k_pi = std::numbers::pi;

/// A rectangle of pixels, from the first column and row to those after the last.
struct Region {
    std::size_t left = 0, right = 0, top = 0, bottom = 0;
    double share = 1;  // of the light of its pixels: less if a single pixel stands for several samples

    std::size_t columns() const { return right - left; }
    std::size_t rows() const { return bottom - top; }
};

/// The light of a region: its integral, per channel, and that of the luminance times the direction.
struct Sent {
    std::array<double, 3> intensity{};
    std::array<double, 3> direction{};

    Sent& operator+=(const Sent& other) {
        for (std::size_t i = 0; i < 3; ++i) {
            intensity[i] += other.intensity[i];
            direction[i] += other.direction[i];
        }
        return *this;
    }
};

/// Rec. 709's. `rgb`: three numbers.
template <class Numbers>
double luminance(const Numbers& rgb) {
    return 0.2126 * double{rgb[0]} + 0.7152 * double{rgb[1]} + 0.0722 * double{rgb[2]};
}

class MedianCut {
  public:
    explicit MedianCut(const Picture& picture)
        : pixels_(picture.intensity.data()),
          columns_(static_cast<std::size_t>(picture.width)),
          rows_(static_cast<std::size_t>(picture.height)) {}

    std::vector<float> samples() const {
        std::vector<Region> regions{{.right = columns_, .bottom = rows_}};
        for (int level = 0; level < k_levels; ++level) {
            std::vector<Region> halves;
            for (const Region& region : regions) split(region, halves);
            regions = std::move(halves);
        }
        std::vector<Sent> sent(regions.size());
        std::ranges::transform(regions, sent.begin(), [&](const Region& region) { return sent_by(region); });
        // Each level sums up pairs of the next one.
        std::vector<float> numbers(6 * (2 * sent.size() - 1));
        for (std::size_t count = sent.size();; count /= 2) {
            for (std::size_t i = 0; i < count; ++i) write(sent[i], &numbers[6 * (count - 1 + i)]);
            if (count == 1) return numbers;
            for (std::size_t i = 0; i < count / 2; ++i) {
                Sent both = sent[2 * i];
                both += sent[2 * i + 1];
                sent[i] = both;
            }
        }
    }

  private:
    /// The polar angle of the upper edge of a row.
    double angle_above(std::size_t row) const {
        return k_pi * static_cast<double>(row) / static_cast<double>(rows_);
    }

    double solid_angle(std::size_t row) const {
        return 2 * k_pi / static_cast<double>(columns_) *
               (std::cos(angle_above(row)) - std::cos(angle_above(row + 1)));
    }

    const float* pixel(std::size_t column, std::size_t row) const {
        return pixels_ + 3 * (row * columns_ + column);
    }

    /// Divides the longer side so that both parts send about the same.
    void split(const Region& region, std::vector<Region>& halves) const {
        const double middle = 0.5 * (angle_above(region.top) + angle_above(region.bottom));
        const double width = static_cast<double>(region.columns()) * 2 * k_pi /
                             static_cast<double>(columns_) * std::sin(middle),
                     height = static_cast<double>(region.rows()) * k_pi / static_cast<double>(rows_);
        Region first = region, second = region;
        if (region.columns() == 1 && region.rows() == 1) {
            first.share = second.share = 0.5 * region.share;
        } else if (region.rows() == 1 || (region.columns() > 1 && width >= height)) {
            first.right = second.left = region.left + median(by_column(region));
        } else {
            first.bottom = second.top = region.top + median(by_row(region));
        }
        halves.push_back(first);
        halves.push_back(second);
    }

    std::vector<double> by_column(const Region& region) const {
        std::vector<double> sums(region.columns());
        for (std::size_t row = region.top; row < region.bottom; ++row) {
            const double weight = solid_angle(row);
            for (std::size_t i = 0; i < sums.size(); ++i)
                sums[i] += weight * luminance(pixel(region.left + i, row));
        }
        return sums;
    }

    std::vector<double> by_row(const Region& region) const {
        std::vector<double> sums(region.rows());
        for (std::size_t i = 0; i < sums.size(); ++i) {
            for (std::size_t column = region.left; column < region.right; ++column)
                sums[i] += luminance(pixel(column, region.top + i));
            sums[i] *= solid_angle(region.top + i);
        }
        return sums;
    }

    /// How many of the numbers, at least one and not all, have about half of their sum.
    static std::size_t median(const std::vector<double>& numbers) {
        double sum = 0;
        for (const double number : numbers) sum += number;
        if (!(sum > 0)) return numbers.size() / 2;
        double before = 0;
        for (std::size_t count = 1; count < numbers.size(); ++count) {
            const double with = before + numbers[count - 1];
            if (with >= 0.5 * sum) {
                // The one that contains the median belongs to the smaller part.
                const bool is_closer_without = count > 1 && 0.5 * sum - before < with - 0.5 * sum;
                return is_closer_without ? count - 1 : count;
            }
            before = with;
        }
        return numbers.size() - 1;
    }

    Sent sent_by(const Region& region) const {
        Sent sent;
        for (std::size_t row = region.top; row < region.bottom; ++row) {
            const double weight = region.share * solid_angle(row);
            const double down = 0.5 * (angle_above(row) + angle_above(row + 1));
            for (std::size_t column = region.left; column < region.right; ++column) {
                const float* const rgb = pixel(column, row);
                const double across =
                    2 * k_pi * ((static_cast<double>(column) + 0.5) / static_cast<double>(columns_) - 0.5);
                const double light = weight * luminance(rgb);
                sent.direction[0] += light * std::sin(down) * std::sin(across);
                sent.direction[1] += light * std::cos(down);
                sent.direction[2] -= light * std::sin(down) * std::cos(across);
                for (std::size_t i = 0; i < 3; ++i) sent.intensity[i] += weight * double{rgb[i]};
            }
        }
        return sent;
    }

    static void write(const Sent& sent, float* to) {
        const auto& d = sent.direction;
        const double length = std::sqrt(d[0] * d[0] + d[1] * d[1] + d[2] * d[2]);
        // Light that comes from all sides equally, or none: any direction.
        const double total = luminance(sent.intensity);
        const bool has_direction = length > 1e-6 * total && length > 0;
        for (std::size_t i = 0; i < 3; ++i) {
            to[i] = has_direction ? static_cast<float>(d[i] / length) : (i == 1 ? 1.0f : 0.0f);
            to[3 + i] = static_cast<float>(sent.intensity[i] / k_pi);
        }
    }

    const float* pixels_;
    std::size_t columns_, rows_;
};

/// A picture with few pixels, drawn with more: a sample's region consists of whole pixels.
Picture enlarged(const Picture& small, int columns) {
    Picture large{.width = columns, .height = columns / 2, .intensity = {}};
    large.intensity.reserve(3 * static_cast<std::size_t>(large.width) *
                            static_cast<std::size_t>(large.height));
    for (int row = 0; row < large.height; ++row) {
        for (int column = 0; column < large.width; ++column) {
            const double down = k_pi * (row + 0.5) / large.height,
                         across = 2 * k_pi * ((column + 0.5) / large.width - 0.5);
            const Vec3 rgb = seen(small, {static_cast<float>(std::sin(down) * std::sin(across)),
                                          static_cast<float>(std::cos(down)),
                                          static_cast<float>(-std::sin(down) * std::cos(across))});
            large.intensity.insert(large.intensity.end(), {rgb.x, rgb.y, rgb.z});
        }
    }
    return large;
}

}  // namespace

Vec3 seen(const Picture& picture, Vec3 towards) {
    const int width = picture.width, height = picture.height;
    const double u = 0.5 + std::atan2(double{towards.x}, -double{towards.z}) / (2 * k_pi);
    const double v = std::acos(std::clamp(double{towards.y}, -1.0, 1.0)) / k_pi;
    const double x = u * width - 0.5, y = std::clamp(v * height - 0.5, 0.0, height - 1.0);
    const double left = std::floor(x), top = std::floor(y);
    const auto across = static_cast<float>(x - left), down = static_cast<float>(y - top);
    const auto wrapped = [&](int column) { return static_cast<std::size_t>((column + width) % width); };
    const std::size_t c0 = wrapped(static_cast<int>(left)), c1 = wrapped(static_cast<int>(left) + 1);
    const auto r0 = static_cast<std::size_t>(top),
               r1 = std::min(r0 + 1, static_cast<std::size_t>(height) - 1);
    const auto at = [&](std::size_t column, std::size_t row) {
        const float* const rgb = &picture.intensity[3 * (row * static_cast<std::size_t>(width) + column)];
        return Vec3{rgb[0], rgb[1], rgb[2]};
    };
    const Vec3 upper = (1 - across) * at(c0, r0) + across * at(c1, r0),
               lower = (1 - across) * at(c0, r1) + across * at(c1, r1);
    return (1 - down) * upper + down * lower;
}

std::vector<float> median_cut(const Picture& picture) {
    constexpr int k_enough = 512;
    return picture.width < k_enough ? MedianCut(enlarged(picture, k_enough)).samples()
                                    : MedianCut(picture).samples();
}

}  // namespace candela::environment_light
