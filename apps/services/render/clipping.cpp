#include "render/clipping.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <string>

import candela.api;
import candela.raster;
import candela.scene;
import candela.shading;

namespace candela {

namespace {

/// Highlights are clipped in most pictures; a larger part was hardly meant to be.
constexpr double k_large_share = 0.1;

std::uint8_t byte_of(float shown) { return static_cast<std::uint8_t>(std::lround(255 * shown)); }

/// The bytes of the pixels that show nothing but the background.
class Background {
  public:
    Background(const RenderScene& scene, const DisplayTransform& transform)
        : environment_(scene.environment),
          transform_(transform),
          width_(static_cast<std::size_t>(scene.image.width)),
          camera_(camera_of(scene.observer, scene.image.width, scene.image.height)) {}

    std::array<std::uint8_t, 3> at(std::size_t pixel) const {
        const Vec3 towards = camera_.view_through(static_cast<float>(pixel % width_) + 0.5f,
                                                  static_cast<float>(pixel / width_) + 0.5f);
        const Rgb shown = displayed(environment_.seen(towards), transform_);
        return {byte_of(shown.r), byte_of(shown.g), byte_of(shown.b)};
    }

  private:
    const EnvironmentMap& environment_;
    DisplayTransform transform_;
    std::size_t width_;
    Camera camera_;
};

}  // namespace

std::string clipping_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics) {
    const DisplayTransform transform = display_of(scene);
    if (film.view().pixels == PixelType::real || transform.tone != ToneCurve::none) return {};
    if (transform.exposure * statistics.brightest <= 1) return {};
    const Background background(scene, transform);
    const std::span<const std::uint8_t> bytes = film.view().bytes;
    std::size_t clipped = 0;
    // From one full channel to the next: most pictures have few.
    for (std::size_t i = 0; i < bytes.size();) {
        const void* const full = std::memchr(&bytes[i], 255, bytes.size() - i);
        if (full == nullptr) break;
        const std::size_t pixel =
            static_cast<std::size_t>(static_cast<const std::uint8_t*>(full) - bytes.data()) / 3;
        if (!std::ranges::equal(background.at(pixel), bytes.subspan(3 * pixel, 3))) ++clipped;
        i = 3 * (pixel + 1);
    }
    const double share = 3.0 * static_cast<double>(clipped) / static_cast<double>(bytes.size());
    if (share < k_large_share) return {};
    return fmt::format(
        "{:.0f} % of the pixels are clipped: light of intensity {:.2g} is shown as {:.2g}; --tone agx shows "
        "it, or a higher --exposure",
        100 * share, statistics.brightest, 1 / transform.exposure);
}

}  // namespace candela
