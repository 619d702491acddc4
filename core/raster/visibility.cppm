module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <span>

export module candela.raster:visibility;

import :projected_scene;
import candela.util;

export namespace candela {

inline constexpr std::uint32_t k_no_triangle = 0xffff'ffffu;

/// Sub-pixel positions of the samples, in sixteenths of a pixel from its top left.
struct SamplePosition {
    std::uint8_t x, y;
};
/// For 1, 4, 8 or 16 samples per pixel: the centre, or the patterns of the D3D 11 specification.
CANDELA_EXPORT std::span<const SamplePosition> sample_pattern(int samples) noexcept;

/// The triangles that one tile sees. Reused from tile to tile.
struct TileVisibility {
    int x0 = 0, y0 = 0;         // its top left pixel
    int width = 0, height = 0;  // the part of it that is in the picture
    int stride = 0;             // of a row, a multiple of 16
    int samples = 1;
    AlignedVector<std::uint32_t> triangle;  // sample by sample, row by row; k_no_triangle: background
    AlignedVector<float> depth;

    inline std::size_t plane() const {
        return static_cast<std::size_t>(stride) * static_cast<std::size_t>(stride);
    }
    inline std::uint32_t at(int sample, int px, int py) const {
        return triangle[static_cast<std::size_t>(sample) * plane() +
                        static_cast<std::size_t>(py * stride + px)];
    }
};

/// Finds what tile `tile`, 0 <= tile < tile_count(), sees: the nearest triangle at each sample, and the first
/// among equally near ones. A sample on a shared edge belongs to only one triangle (top-left rule). Returns
/// false if no triangle comes near the tile; `visibility` then has only its position. Any thread.
CANDELA_EXPORT bool rasterize(const ProjectedScene& scene, int tile, TileVisibility& visibility);

/// Finds what the tile of `before` sees behind that: at each sample, the nearest triangle behind the depth
/// and the triangle there (Everitt 2001, "Interactive order-independent transparency"). Equally near ones
/// come in the scene's order. Samples with a depth of minus infinity see nothing.
CANDELA_EXPORT void rasterize_behind(const ProjectedScene& scene, const TileVisibility& before,
                                     TileVisibility& visibility);

}  // namespace candela
