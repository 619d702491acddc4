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
import candela.scene;

namespace candela {

namespace {

/// Highlights are clipped in most pictures; a larger part was hardly meant to be.
constexpr double k_large_share = 0.1;

std::uint8_t byte_of(float shown) { return static_cast<std::uint8_t>(std::lround(255 * shown)); }

}  // namespace

std::string clipping_diagnosis(const RenderScene& scene, const Film& film,
                               const RenderStatistics& statistics) {
    const DisplayTransform transform = display_of(scene);
    if (film.view().pixels == PixelType::real || transform.tone != ToneCurve::none) return {};
    if (transform.exposure * statistics.brightest <= 1) return {};
    const Rgb background =
        scene.environment.is_uniform() ? displayed(scene.environment.seen({}), transform) : Rgb{};
    const std::array<std::uint8_t, 3> own{byte_of(background.r), byte_of(background.g),
                                          byte_of(background.b)};
    const std::span<const std::uint8_t> bytes = film.view().bytes;
    std::size_t clipped = 0;
    // From one full channel to the next: most pictures have few.
    for (std::size_t i = 0; i < bytes.size();) {
        const void* const full = std::memchr(&bytes[i], 255, bytes.size() - i);
        if (full == nullptr) break;
        const std::size_t pixel =
            static_cast<std::size_t>(static_cast<const std::uint8_t*>(full) - bytes.data()) / 3 * 3;
        if (!std::equal(own.begin(), own.end(), &bytes[pixel])) ++clipped;
        i = pixel + 3;
    }
    const double share = 3.0 * static_cast<double>(clipped) / static_cast<double>(bytes.size());
    if (share < k_large_share) return {};
    return fmt::format(
        "{:.0f} % of the pixels are clipped: light of intensity {:.2g} is shown as {:.2g}; --tone agx shows "
        "it, or a higher --exposure",
        100 * share, statistics.brightest, 1 / transform.exposure);
}

}  // namespace candela
