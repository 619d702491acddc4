#include "verify/bias.h"

#include <fmt/format.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <string>
#include <vector>

import candela.util;

using candela::Error;
using candela::ErrorCategory;

namespace verify {

namespace {

constexpr double k_undecided = 0.01;  // levels from the rounding threshold
constexpr double k_white = 255;
constexpr std::size_t k_region = 16;           // pixels each way
constexpr std::size_t k_least_of_region = 64;  // values; the mean of fewer is mostly noise

constexpr int k_causes = 4;  // as in Bias: gain, right, down, zoom
using Causes = Eigen::Matrix<double, k_causes, 1>;

/// Finds the causes c that minimise the differences d = effects . c, and their standard errors, which hold
/// even if the variances of the differences vary: White (1980), A heteroskedasticity-consistent covariance
/// matrix estimator.
class Fit {
  public:
    void add(const Causes& effects, double difference) {
        normal_ += effects * effects.transpose();
        if (difference == 0) return;
        right_side_ += difference * effects;
        noise_ += difference * difference * effects * effects.transpose();
    }

    void solve() {
        // A cause without an effect on the picture, such as a displacement of one colour, is 0.
        const Causes scale =
            normal_.diagonal().cwiseSqrt().unaryExpr([](double x) { return x > 0 ? 1 / x : 0.0; });
        const Matrix scaled = scale.asDiagonal() * normal_ * scale.asDiagonal();
        const Matrix inverse = scale.asDiagonal() * scaled.completeOrthogonalDecomposition().pseudoInverse() *
                               scale.asDiagonal();
        values_ = inverse * right_side_;
        errors_ = (inverse * noise_ * inverse).diagonal().cwiseMax(0).cwiseSqrt();
    }
    const Causes& values() const { return values_; }
    Estimate estimate(int cause) const {
        return {.value = values_[cause],
                .deviations = errors_[cause] > 0 ? std::abs(values_[cause]) / errors_[cause] : 0};
    }

  private:
    using Matrix = Eigen::Matrix<double, k_causes, k_causes>;
    Matrix normal_ = Matrix::Zero(), noise_ = Matrix::Zero();
    Causes right_side_ = Causes::Zero(), values_ = Causes::Zero(), errors_ = Causes::Zero();
};

/// The growth of a value in levels relative to that of the intensity: dL / d ln I.
double effect_of_gain(double level, candela::ColorEncoding encoding) {
    if (level >= k_white) return 0;
    constexpr double k_linear = 12.92 * 0.0031308 * k_white, k_offset = 0.055 * k_white, k_exponent = 1 / 2.4;
    if (encoding == candela::ColorEncoding::none || level <= k_linear) return level;
    return k_exponent * (level + k_offset);
}

/// The effect of each cause, of size 1, on the i-th value.
Causes effects_on(const Expectation& expected, std::size_t i) {
    const auto width = static_cast<std::size_t>(expected.width);
    const std::size_t column = i / 3 % width, row = i / 3 / width;
    const double x = static_cast<double>(column) + 0.5 - 0.5 * expected.width;
    const double y = static_cast<double>(row) + 0.5 - 0.5 * expected.height;
    // A picture displaced to the right shows what was further left.
    const double right = -static_cast<double>(expected.sensitivity.right[i]);
    const double down = -static_cast<double>(expected.sensitivity.down[i]);
    Causes effects;
    effects << effect_of_gain(static_cast<double>(expected.levels[i]), expected.encoding), right, down,
        right * x + down * y;
    return effects;
}

/// A mean of differences, and its certainty. A pixel's channels err together, for instance where its place in
/// a texture is rounded, so that only pixels are independent: Liang and Zeger (1986), Longitudinal data
/// analysis using generalized linear models.
class Mean {
  public:
    /// `sum`: of one pixel's `count` differences.
    void add(double sum, std::size_t count) {
        sum_ += sum;
        squares_ += sum * sum;
        count_ += count;
    }
    std::size_t count() const { return count_; }
    Estimate estimate() const {
        if (squares_ == 0) return {};
        return {.value = sum_ / static_cast<double>(count_),
                .deviations = std::abs(sum_) / std::sqrt(squares_)};
    }

  private:
    double sum_ = 0, squares_ = 0;
    std::size_t count_ = 0;
};

/// Whether any correct program must round as Candela does.
bool is_decided(float level) {
    const double fraction = static_cast<double>(level) - std::floor(static_cast<double>(level));
    return std::abs(fraction - 0.5) > k_undecided;
}

}  // namespace

Bias bias_of(const Expectation& expected, const std::vector<std::uint8_t>& program) {
    Bias bias;
    const auto for_each_decided = [&](const auto& visit) {
        for (std::size_t i = 0; i < expected.levels.size(); ++i) {
            if (!expected.shown[i / 3] || expected.sensitivity.edges[i / 3] ||
                !is_decided(expected.levels[i]))
                continue;
            visit(i, static_cast<double>(program[i]) -
                         std::floor(static_cast<double>(expected.levels[i]) + 0.5));
        }
    };
    for (std::size_t pixel = 0; pixel < expected.pixels(); ++pixel) {
        if (!expected.shown[pixel]) continue;
        ++bias.shown;
        if (!expected.sensitivity.edges[pixel]) ++bias.interior;
    }

    Fit fit;
    for_each_decided([&](std::size_t i, double difference) { fit.add(effects_on(expected, i), difference); });
    fit.solve();
    Estimate* const estimates[k_causes] = {&bias.gain, &bias.right, &bias.down, &bias.zoom};
    for (int cause = 0; cause < k_causes; ++cause) *estimates[cause] = fit.estimate(cause);

    const auto columns = static_cast<std::size_t>(expected.width);
    const std::size_t across = (columns + k_region - 1) / k_region;
    const std::size_t rows = (static_cast<std::size_t>(expected.height) + k_region - 1) / k_region;
    std::vector<Mean> regions(across * rows);
    double sum = 0;
    std::size_t count = 0, pixel = 0;
    const auto end_pixel = [&] {
        const std::size_t x = pixel % columns, y = pixel / columns;
        if (count > 0) regions[y / k_region * across + x / k_region].add(sum, count);
        sum = 0;
        count = 0;
    };
    for_each_decided([&](std::size_t i, double difference) {
        if (i / 3 != pixel) end_pixel();
        pixel = i / 3;
        sum += difference - effects_on(expected, i).dot(fit.values());
        ++count;
    });
    end_pixel();
    for (std::size_t i = 0; i < regions.size(); ++i) {
        if (regions[i].count() < k_least_of_region) continue;
        const Estimate mean = regions[i].estimate();
        if (std::abs(mean.value) <= std::abs(bias.region.value)) continue;
        bias.region = mean;
        bias.region_x = static_cast<int>(k_region * (i % across));
        bias.region_y = static_cast<int>(k_region * (i / across));
    }
    return bias;
}

RgbImage read_ppm(const std::filesystem::path& file) {
    const auto content = candela::read_text_file(file);
    RgbImage image;
    std::string magic;
    int largest = 0;
    std::istringstream header(content.value_or(""));
    header >> magic >> image.width >> image.height >> largest;
    const auto size = 3 * static_cast<std::size_t>(std::max(image.width, 0)) *
                      static_cast<std::size_t>(std::max(image.height, 0));
    const auto begin = static_cast<std::size_t>(std::max<std::streamoff>(header.tellg(), 0)) + 1;
    if (!header || magic != "P6" || largest != 255 || !content || content->size() != begin + size)
        throw Error(ErrorCategory::failure,
                    fmt::format("'{}' is not the picture that the program wrote", file.string()));
    image.bytes.assign(content->begin() + static_cast<std::ptrdiff_t>(begin), content->end());
    return image;
}

}  // namespace verify
