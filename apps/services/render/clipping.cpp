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

using Bytes = std::array<std::uint8_t, 3>;

/// The bytes of pixels that show nothing but the background.
class Background {
  public:
    Background(const RenderScene& scene, const DisplayTransform& transform)
        : environment_(scene.environment),
          transform_(transform),
          width_(static_cast<std::size_t>(scene.image.width)),
          camera_(camera_of(scene.observer, scene.image.width, scene.image.height)) {}

    Bytes everywhere() const { return shown({}); }
    Bytes at(std::size_t pixel) const {
        const std::size_t column = pixel % width_, row = pixel / width_;
        return shown(camera_.view_through(static_cast<float>(column) + 0.5f, static_cast<float>(row) + 0.5f));
    }

  private:
    Bytes shown(Vec3 towards) const {
        const Rgb color = displayed(environment_.seen(towards), transform_);
        return {byte_of(color.r), byte_of(color.g), byte_of(color.b)};
    }

    const EnvironmentMap& environment_;
    DisplayTransform transform_;
    std::size_t width_;
    Camera camera_;
};

/// How many pixels have a full channel and not the bytes of `background(pixel)`.
template <class OfPixel>
std::size_t count_clipped(std::span<const std::uint8_t> bytes, OfPixel background) {
    std::size_t clipped = 0;
    // From one full channel to the next: most pictures have few.
    for (std::size_t i = 0; i < bytes.size();) {
        const void* const full = std::memchr(&bytes[i], 255, bytes.size() - i);
        if (full == nullptr) break;
        const std::size_t pixel =
            static_cast<std::size_t>(static_cast<const std::uint8_t*>(full) - bytes.data()) / 3;
        const Bytes& own = background(pixel);
        if (!std::equal(own.begin(), own.end(), &bytes[3 * pixel])) ++clipped;
        i = 3 * (pixel + 1);
    }
    return clipped;
}

}  // namespace

std::string clipping_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics) {
    const DisplayTransform transform = display_of(scene);
    if (film.view().pixels == PixelType::real || transform.tone != ToneCurve::none) return {};
    if (transform.exposure * statistics.brightest <= 1) return {};
    const Background background(scene, transform);
    const std::span<const std::uint8_t> bytes = film.view().bytes;
    const Bytes everywhere = background.everywhere();
    const std::size_t clipped =
        scene.environment.is_uniform()
            ? count_clipped(bytes, [&](std::size_t) -> const Bytes& { return everywhere; })
            : count_clipped(bytes, [&](std::size_t pixel) { return background.at(pixel); });
    const double share = 3.0 * static_cast<double>(clipped) / static_cast<double>(bytes.size());
    if (share < k_large_share) return {};
    return fmt::format(
        "{:.0f} % of the pixels are clipped: light of intensity {:.2g} is shown as {:.2g}; --tone agx shows "
        "it, or a higher --exposure",
        100 * share, statistics.brightest, 1 / transform.exposure);
}

}  // namespace candela
