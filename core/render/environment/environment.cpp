module;

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <utility>
#include <vector>

module candela.environment;

namespace candela {

Environment::Environment(Rgb everywhere) : everywhere_(everywhere) {}

Environment::Environment(int width, int height, std::vector<float> intensity)
    : width_(width), height_(height), intensity_(std::move(intensity)) {}

Rgb Environment::pixel(int column, int row) const noexcept {
    const std::size_t first = 3 * (static_cast<std::size_t>(row) * static_cast<std::size_t>(width_) +
                                   static_cast<std::size_t>(column));
    return {intensity_[first], intensity_[first + 1], intensity_[first + 2]};
}

Rgb Environment::seen(Vec3 towards) const noexcept {
    if (is_uniform()) return everywhere_;
    constexpr float k_pi = std::numbers::pi_v<float>;
    const float u = 0.5f + std::atan2(towards.x, -towards.z) / (2 * k_pi);
    const float v = std::acos(std::clamp(towards.y, -1.0f, 1.0f)) / k_pi;
    const float x = u * static_cast<float>(width_) - 0.5f;
    const float y = std::clamp(v * static_cast<float>(height_) - 0.5f, 0.0f, static_cast<float>(height_ - 1));
    const auto left = static_cast<int>(std::floor(x));
    const auto top = static_cast<int>(y);
    const float s = x - static_cast<float>(left), t = y - static_cast<float>(top);
    const auto around = [&](int column) { return ((column % width_) + width_) % width_; };
    const int bottom = std::min(top + 1, height_ - 1);
    const auto row = [&](int which) {
        return (1 - s) * pixel(around(left), which) + s * pixel(around(left + 1), which);
    };
    return (1 - t) * row(top) + t * row(bottom);
}

}  // namespace candela
