#include "verify/edges.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <numbers>

using candela::Observer;
using candela::Projection;
using candela::Vec3;

namespace verify {

namespace {

// Pixels.
constexpr float k_shift = 1.0f / 16;  // more than all rounding of places on the picture

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

using Bytes = std::vector<std::uint8_t>;

/// Pictures of a scene whose observer, and whose number of samples, come back to what they were.
class Mover {
  public:
    explicit Mover(candela::CompiledScene& scene, const candela::Film& reference)
        : scene_(scene), reference_(reference), observer_(scene.observer), samples_(scene.image.samples) {}
    Mover(const Mover&) = delete;
    Mover& operator=(const Mover&) = delete;
    ~Mover() { restore(); }

    /// What is seen where the picture moves by (x, y) pixels.
    Bytes moved(float x, float y, int samples) {
        scene_.observer = shifted(observer_, x, y, reference_.height());
        scene_.image.samples = samples;
        candela::Film film(reference_.width(), reference_.height(), candela::PixelType::byte,
                           scene_.image.color_management);
        candela::render(scene_, film, {});
        restore();
        return {film.view().bytes.begin(), film.view().bytes.end()};
    }

  private:
    void restore() {
        scene_.observer = observer_;
        scene_.image.samples = samples_;
    }

    candela::CompiledScene& scene_;
    const candela::Film& reference_;
    Observer observer_;
    int samples_;
};

}  // namespace

std::vector<bool> edge_pixels(candela::CompiledScene& scene, const candela::Film& reference, float levels) {
    const auto expected = reference.view().bytes;
    std::vector<bool> edges(expected.size() / 3, false);
    Mover mover(scene, reference);
    const int samples = scene.image.samples;
    for (const float x : {-k_shift, k_shift}) {
        for (const float y : {-k_shift, k_shift}) {
            const Bytes moved = mover.moved(x, y, samples);
            for (std::size_t i = 0; i < moved.size(); ++i) {
                const int change = std::abs(int{moved[i]} - int{expected[i]});
                if (static_cast<float>(change) > levels) edges[i / 3] = true;
            }
        }
    }
    if (samples == 1) return edges;
    const Bytes centre = mover.moved(0, 0, 1);
    std::vector<int> sum(centre.size());
    for (const auto& [x, y] : candela::sample_pattern(samples)) {
        const Bytes moved =
            mover.moved(0.5f - static_cast<float>(x) / 16, 0.5f - static_cast<float>(y) / 16, 1);
        for (std::size_t i = 0; i < moved.size(); ++i) sum[i] += moved[i];
    }
    for (std::size_t i = 0; i < centre.size(); ++i) {
        const int bend = std::abs(sum[i] - samples * int{centre[i]});
        if (static_cast<float>(bend) > static_cast<float>(samples) * levels) edges[i / 3] = true;
    }
    return edges;
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
