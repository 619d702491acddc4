#include "verify/edges.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>
#include <vector>

using candela::Observer;
using candela::Projection;
using candela::Vec3;

namespace verify {

namespace {

constexpr float k_shift = 1.0f / 8;  // pixels; OpenGL may round vertices to a sixteenth

/// The observer, turned or moved so little that the picture moves by (x, y) pixels.
Observer shifted(const Observer& observer, float x, float y, int height) {
    const Vec3 forward = observer.look_at - observer.position;
    const Vec3 right = candela::normalized(candela::cross(forward, observer.up));
    const Vec3 up = candela::normalized(candela::cross(right, forward));
    const auto rows = static_cast<float>(height);
    Observer result = observer;
    if (observer.projection == Projection::perspective) {
        const float half = 0.5f * observer.fov * std::numbers::pi_v<float> / 180;
        const float pixel = 2 * std::tan(half) / rows * candela::length(forward);
        result.look_at = observer.look_at - x * pixel * right + y * pixel * up;
    } else {
        const Vec3 move = observer.height / rows * (y * up - x * right);
        result.position = observer.position + move;
        result.look_at = observer.look_at + move;
    }
    return result;
}

using Intensities = std::vector<float>;

/// Pictures of a scene with one sample a pixel. Its observer and its samples come back to what they were.
class Mover {
  public:
    Mover(candela::CompiledScene& scene, const candela::Film& reference)
        : scene_(scene), reference_(reference), observer_(scene.observer), samples_(scene.image.samples) {
        scene_.image.samples = 1;
    }
    Mover(const Mover&) = delete;
    Mover& operator=(const Mover&) = delete;
    ~Mover() {
        scene_.observer = observer_;
        scene_.image.samples = samples_;
    }

    /// What is seen at each pixel's place (x, y), from its top left.
    Intensities seen_at(float x, float y) {
        scene_.observer = shifted(observer_, 0.5f - x, 0.5f - y, reference_.height());
        candela::Film film(reference_.width(), reference_.height(), candela::PixelType::real,
                           scene_.image.color_management);
        candela::render(scene_, film, {});
        return {film.view().reals.begin(), film.view().reals.end()};
    }

  private:
    candela::CompiledScene& scene_;
    const candela::Film& reference_;
    Observer observer_;
    int samples_;
};

/// In a picture's file, 0 to 255, not rounded.
float level_of(float intensity, candela::ColorEncoding encoding) {
    const float x = std::clamp(intensity, 0.0f, 1.0f);
    return 255 * (encoding == candela::ColorEncoding::srgb ? candela::linear_to_srgb(x) : x);
}

}  // namespace

std::vector<float> unrounded_picture(const candela::CompiledScene& scene) {
    const auto encoding = scene.image.color_management;
    candela::Film film(scene.image.width, scene.image.height, candela::PixelType::real, encoding);
    candela::render(scene, film, {});
    std::vector<float> levels(film.view().reals.begin(), film.view().reals.end());
    for (float& x : levels) x = level_of(x, encoding);
    return levels;
}

Sensitivity sensitivity_of(candela::CompiledScene& scene, const candela::Film& reference, float levels) {
    const auto pattern = candela::sample_pattern(scene.image.samples);
    const auto encoding = scene.image.color_management;
    const auto expected = reference.view().bytes;
    const float share = 1 / static_cast<float>(pattern.size());
    std::vector<float> change(expected.size()), mean(expected.size());
    // What is seen an eighth of a pixel to the left, to the right, above and below.
    std::array<Intensities, 2> beside_x, beside_y;
    for (auto* const means : {&beside_x, &beside_y})
        for (Intensities& each : *means) each.resize(expected.size());
    Mover mover(scene, reference);
    for (const candela::SamplePosition& sample : pattern) {
        const float x = static_cast<float>(sample.x) / 16, y = static_cast<float>(sample.y) / 16;
        const Intensities there = mover.seen_at(x, y);
        std::vector<float> largest(there.size());
        for (const float dx : {-k_shift, k_shift}) {
            for (const float dy : {-k_shift, k_shift}) {
                const Intensities beside = mover.seen_at(x + dx, y + dy);
                Intensities& mean_x = beside_x[dx > 0 ? 1 : 0];
                Intensities& mean_y = beside_y[dy > 0 ? 1 : 0];
                for (std::size_t i = 0; i < there.size(); ++i) {
                    mean_x[i] += 0.5f * share * beside[i];
                    mean_y[i] += 0.5f * share * beside[i];
                    if (beside[i] == there[i]) continue;
                    const float moved =
                        std::abs(level_of(beside[i], encoding) - level_of(there[i], encoding));
                    largest[i] = std::max(largest[i], moved);
                }
            }
        }
        for (std::size_t i = 0; i < there.size(); ++i) {
            change[i] += share * largest[i];
            mean[i] += share * there[i];
        }
    }
    Sensitivity result{.edges = std::vector<bool>(expected.size() / 3, false),
                       .right = std::vector<float>(expected.size()),
                       .down = std::vector<float>(expected.size())};
    const auto slope = [&](const std::array<Intensities, 2>& means, std::size_t i) {
        return (level_of(means[1][i], encoding) - level_of(means[0][i], encoding)) / (2 * k_shift);
    };
    for (std::size_t i = 0; i < expected.size(); ++i) {
        const float apart = std::abs(level_of(mean[i], encoding) - static_cast<float>(expected[i]));
        if (change[i] > levels || apart > levels) result.edges[i / 3] = true;
        result.right[i] = slope(beside_x, i);
        result.down[i] = slope(beside_y, i);
    }
    return result;
}

candela::Film mask_of(const std::vector<bool>& edges, int width, int height) {
    candela::Film mask(width, height, candela::PixelType::byte, candela::ColorEncoding::none);
    mask.fill(0, 0, width, height, {0, 0, 0});
    for (std::size_t i = 0; i < edges.size(); ++i) {
        const auto columns = static_cast<std::size_t>(width);
        if (edges[i])
            mask.fill(static_cast<int>(i % columns), static_cast<int>(i / columns), 1, 1, {1, 1, 1});
    }
    return mask;
}

}  // namespace verify
