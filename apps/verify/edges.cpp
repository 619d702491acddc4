#include "verify/edges.h"

#include <cmath>
#include <cstddef>
#include <cstdlib>
#include <numbers>

using candela::Observer;
using candela::Projection;
using candela::Vec3;

namespace verify {

namespace {

constexpr float k_shift = 1.0f / 16;  // pixels

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

}  // namespace

std::vector<bool> edge_pixels(candela::CompiledScene& scene, const candela::Film& reference, float levels) {
    const int width = reference.width(), height = reference.height();
    const auto expected = reference.view().bytes;
    std::vector<bool> edges(expected.size() / 3, false);
    const Observer original = scene.observer;
    for (const float x : {-k_shift, k_shift}) {
        for (const float y : {-k_shift, k_shift}) {
            scene.observer = shifted(original, x, y, height);
            candela::Film film(width, height, candela::PixelType::byte, scene.image.color_management);
            candela::render(scene, film, {});
            const auto actual = film.view().bytes;
            for (std::size_t i = 0; i < actual.size(); ++i) {
                if (std::abs(int{actual[i]} - int{expected[i]}) > static_cast<int>(levels))
                    edges[i / 3] = true;
            }
        }
    }
    scene.observer = original;
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
