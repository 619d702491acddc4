// Rasterisation of one tile: edge functions (Pineda 1988) in fixed point, and a depth test.
module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

module candela.raster;

import :bounds;
import :small_triangles;

namespace candela {

namespace {

constexpr int k_block = 16;  // pixels of a row that are tested at once

/// One sample of each pixel of a tile, row by row.
struct SamplePlane {
    int stride;
    float* depth;
    std::uint32_t* triangle;
};

/// A triangle relative to the tile's first sample, in steps of pixels.
struct TileTriangle {
    std::int32_t e[3];       // edge functions, >= 0 inside
    std::int32_t ex[3];      // their steps to the right
    std::int32_t ey[3];      // and downwards
    float z, zx, zy;         // depth at the anchor, and its steps
    int anchor_x, anchor_y;  // a pixel near the triangle, independent of the tile, as rounding must be
    std::uint32_t id;
    int x0, x1, y0, y1;  // pixels covered by its box; x0 and x1 are multiples of k_block
};

/// Samples see the nearest triangle of all.
struct NoLimits {
    NoLimits from(std::ptrdiff_t) const { return {}; }
    bool admits(std::ptrdiff_t, float, std::uint32_t) const { return true; }
};

/// Samples see the nearest triangle behind a depth and the triangle there; equally near ones come in the
/// scene's order.
struct Limits {
    const float* depth;
    const std::uint32_t* triangle;

    Limits from(std::ptrdiff_t first) const { return {depth + first, triangle + first}; }
    bool admits(std::ptrdiff_t sample, float z, std::uint32_t id) const {
        const float limit = depth[sample];
        const std::uint32_t last = triangle[sample];
        return (id != last) & ((z < limit) | ((z == limit) & (id > last)));
    }
};

template <class Limited>
struct TriangleLoop {
    CANDELA_BATCH_LOOP static void run(TileTriangle t, SamplePlane plane, Limited limits) {
        for (int y = t.y0; y < t.y1; ++y) {
            const std::int32_t row0 = t.e[0] + y * t.ey[0];
            const std::int32_t row1 = t.e[1] + y * t.ey[1];
            const std::int32_t row2 = t.e[2] + y * t.ey[2];
            const float row_z = t.z + static_cast<float>(y - t.anchor_y) * t.zy;
            const std::ptrdiff_t row = std::ptrdiff_t{y} * plane.stride;
            float* const depth = plane.depth + row;
            std::uint32_t* const triangle = plane.triangle + row;
            const Limited limit = limits.from(row);
            for (int block = t.x0; block < t.x1; block += k_block) {
                CANDELA_VECTORIZE_SIXTEEN
                for (int x = block; x < block + k_block; ++x) {
                    const std::int32_t outside =
                        (row0 + x * t.ex[0]) | (row1 + x * t.ex[1]) | (row2 + x * t.ex[2]);
                    const float z = row_z + static_cast<float>(x - t.anchor_x) * t.zx;
                    const float old_z = depth[x];
                    const std::uint32_t old_id = triangle[x];
                    const bool wins = (outside >= 0) & (z > old_z) & limit.admits(x, z, t.id);
                    depth[x] = wins ? z : old_z;
                    triangle[x] = wins ? t.id : old_id;
                }
            }
        }
    }
};

/// A tile's first sample in fixed point, and the distance between its pixels.
struct SampleGrid {
    std::int64_t x, y;
    int bits;
    int width, height;
};

/// Sets up `t` for one sample per pixel of the tile; false if the triangle misses them all.
bool set_up(const RasterTriangle& t, const SampleGrid& grid, TileTriangle& result) {
    const int bits = grid.bits;
    const auto last_x = static_cast<std::int64_t>(grid.width - 1);
    const auto last_y = static_cast<std::int64_t>(grid.height - 1);
    // The pixels whose samples lie within the triangle's box.
    const ScreenVertex &a = t.vertex[0], &b = t.vertex[1], &c = t.vertex[2];
    const std::int32_t left = least(a.x, b.x, c.x), right = most(a.x, b.x, c.x);
    const std::int32_t top = least(a.y, b.y, c.y), bottom = most(a.y, b.y, c.y);
    const std::int64_t up = (std::int64_t{1} << bits) - 1;
    const std::int64_t x0 = std::max<std::int64_t>((left - grid.x + up) >> bits, 0);
    const std::int64_t x1 = std::min<std::int64_t>((right - grid.x) >> bits, last_x);
    const std::int64_t y0 = std::max<std::int64_t>((top - grid.y + up) >> bits, 0);
    const std::int64_t y1 = std::min<std::int64_t>((bottom - grid.y) >> bits, last_y);
    if (x0 > x1 || y0 > y1) return false;
    // Whole blocks are tested.
    const std::int64_t block0 = x0 / k_block * k_block;
    const std::int64_t block1 = (x1 / k_block + 1) * k_block - 1;

    for (int k = 0; k < 3; ++k) {
        const int next = k == 2 ? 0 : k + 1;
        const ScreenVertex &from = t.vertex[k], &to = t.vertex[next];
        const std::int64_t dx = to.x - from.x;
        const std::int64_t dy = to.y - from.y;
        const bool owns_its_samples = dy < 0 || (dy == 0 && dx > 0);  // a left or a top edge
        const std::int64_t at_first =
            dx * (grid.y - from.y) - dy * (grid.x - from.x) - (owns_its_samples ? 0 : 1);
        // In steps of whole pixels: e + steps * 2^bits >= 0 is floor(e / 2^bits) + steps >= 0.
        const std::int64_t e = at_first >> bits;
        const std::int64_t to_right = -dy;
        const std::int64_t down = dx;
        const std::int64_t smallest =
            e + std::min(to_right * block0, to_right * block1) + std::min(down * y0, down * y1);
        const std::int64_t largest =
            e + std::max(to_right * x0, to_right * x1) + std::max(down * y0, down * y1);
        if (largest < 0) return false;
        const bool crosses = smallest < 0;
        result.e[k] = crosses ? static_cast<std::int32_t>(e) : 0;
        result.ex[k] = crosses ? static_cast<std::int32_t>(to_right) : 0;
        result.ey[k] = crosses ? static_cast<std::int32_t>(down) : 0;
    }

    const double x10 = b.x - a.x, y10 = b.y - a.y;
    const double x20 = c.x - a.x, y20 = c.y - a.y;
    const double z10 = static_cast<double>(b.depth) - static_cast<double>(a.depth);
    const double z20 = static_cast<double>(c.depth) - static_cast<double>(a.depth);
    const double area = x10 * y20 - x20 * y10;
    const double zx = (z10 * y20 - z20 * y10) / area;
    const double zy = (z20 * x10 - z10 * x20) / area;
    const auto one = static_cast<double>(std::int64_t{1} << bits);
    // The sample next to the first vertex.
    result.anchor_x = static_cast<int>((a.x - grid.x) >> bits);
    result.anchor_y = static_cast<int>((a.y - grid.y) >> bits);
    const std::int64_t to_anchor_x = grid.x + (std::int64_t{result.anchor_x} << bits) - a.x;
    const std::int64_t to_anchor_y = grid.y + (std::int64_t{result.anchor_y} << bits) - a.y;
    result.z = static_cast<float>(static_cast<double>(a.depth) + zx * static_cast<double>(to_anchor_x) +
                                  zy * static_cast<double>(to_anchor_y));
    result.zx = static_cast<float>(zx * one);
    result.zy = static_cast<float>(zy * one);
    result.id = t.id;
    result.x0 = static_cast<int>(block0);
    result.x1 = static_cast<int>(block1 + 1);
    result.y0 = static_cast<int>(y0);
    result.y1 = static_cast<int>(y1) + 1;
    return true;
}

void clear(TileVisibility& visibility) {
    const std::size_t size = visibility.plane() * static_cast<std::size_t>(visibility.samples);
    visibility.triangle.assign(size, k_no_triangle);
    visibility.depth.assign(size, -std::numeric_limits<float>::infinity());
}

/// Rasterises one tile's triangles.
template <class Limited>
class TileRaster {
  public:
    TileRaster(const ProjectedScene& scene, TileVisibility& visibility, Limited limits)
        : scene_(scene), visibility_(visibility), limits_(limits), pattern_(sample_pattern(scene.samples)) {}

    void see(const TriangleBin& bin, std::span<const BinnedTriangle> triangles) {
        if (scene_.samples > 1) {
            for (const BinnedTriangle& triangle : triangles) rasterize_large(corners_of(bin, triangle));
            return;
        }
        for (std::size_t first = 0; first < triangles.size(); first += SmallTriangles::k_size)
            rasterize_binned(
                bin, triangles.subspan(first, std::min(SmallTriangles::k_size, triangles.size() - first)));
    }

  private:
    RasterTriangle corners_of(const TriangleBin& bin, const BinnedTriangle& triangle) const {
        if (triangle.is_piece()) return bin.pieces[triangle.vertex[1]];
        const ScreenVertex* const vertices = scene_.screen.data();
        return {{vertices[triangle.vertex[0]], vertices[triangle.vertex[1]], vertices[triangle.vertex[2]]},
                triangle.id};
    }

    /// In order, because the first of several equally near ones is visible.
    void rasterize_binned(const TriangleBin& bin, std::span<const BinnedTriangle> triangles) {
        small_.set_up(scene_.screen.data(), triangles.data(), triangles.size(), scene_.subpixel_bits);
        for (std::size_t i = 0; i < triangles.size(); ++i) {
            if (small_.is_small[i] != 0) {
                rasterize_small(i, triangles[i].id);
            } else {
                rasterize_large(corners_of(bin, triangles[i]));
            }
        }
    }

    void rasterize_small(std::size_t i, std::uint32_t id) {
        const std::uint32_t covered = small_.covered[i];
        rasterize_block(i, id, covered & 0xffffu, 0, 0);
        if (covered >> 16 == 0) return;
        const bool is_below = small_.is_tall[i] != 0;
        rasterize_block(i, id, covered >> 16, is_below ? 0 : 4, is_below ? 4 : 0);
    }

    /// A block of four by four pixels that begins at that column and row of the triangle's box.
    void rasterize_block(std::size_t i, std::uint32_t id, std::uint32_t covered, int right, int below) {
        const int x0 = small_.x[i] - visibility_.x0 + right, y0 = small_.y[i] - visibility_.y0 + below;
        const float first = small_.depth[i] + static_cast<float>(right) * small_.to_right[i] +
                            static_cast<float>(below) * small_.down[i];
        for (; covered != 0; covered &= covered - 1) {
            const int bit = std::countr_zero(covered);
            const int column = bit % 4, row = bit / 4;
            const int x = x0 + column, y = y0 + row;
            if (x < 0 || x >= visibility_.width || y < 0 || y >= visibility_.height) continue;
            const std::size_t pixel =
                static_cast<std::size_t>(y) * static_cast<std::size_t>(visibility_.stride) +
                static_cast<std::size_t>(x);
            const float depth = first + static_cast<float>(column) * small_.to_right[i] +
                                static_cast<float>(row) * small_.down[i];
            if (!(depth > visibility_.depth[pixel])) continue;
            if (!limits_.admits(static_cast<std::ptrdiff_t>(pixel), depth, id)) continue;
            visibility_.depth[pixel] = depth;
            visibility_.triangle[pixel] = id;
        }
    }

    void rasterize_large(const RasterTriangle& triangle) {
        const std::int64_t sixteenth = std::int64_t{1} << (scene_.subpixel_bits - 4);
        for (std::size_t s = 0; s < pattern_.size(); ++s) {
            const auto [sx, sy] = pattern_[s];
            const SampleGrid grid{
                .x = (std::int64_t{visibility_.x0} << scene_.subpixel_bits) + sx * sixteenth,
                .y = (std::int64_t{visibility_.y0} << scene_.subpixel_bits) + sy * sixteenth,
                .bits = scene_.subpixel_bits,
                .width = visibility_.width,
                .height = visibility_.height};
            TileTriangle set;
            if (!set_up(triangle, grid, set)) continue;
            const std::size_t plane = s * visibility_.plane();
            multiversion<TriangleLoop<Limited>>(
                set,
                SamplePlane{visibility_.stride, visibility_.depth.data() + plane,
                            visibility_.triangle.data() + plane},
                limits_.from(static_cast<std::ptrdiff_t>(plane)));
        }
    }

    const ProjectedScene& scene_;
    TileVisibility& visibility_;
    Limited limits_;
    std::span<const SamplePosition> pattern_;
    SmallTriangles small_;
};

}  // namespace

bool rasterize(const ProjectedScene& scene, int tile, TileVisibility& visibility) {
    const int column = tile % scene.tile_columns;
    const int row = tile / scene.tile_columns;
    visibility.x0 = column * scene.tile_size;
    visibility.y0 = row * scene.tile_size;
    visibility.width = std::min(scene.tile_size, scene.camera.width - visibility.x0);
    visibility.height = std::min(scene.tile_size, scene.camera.height - visibility.y0);
    visibility.stride = scene.tile_size;
    visibility.samples = scene.samples;

    TileRaster raster(scene, visibility, NoLimits{});
    bool is_cleared = false;
    for (const TriangleBin& bin : scene.bins) {
        const std::span<const BinnedTriangle> triangles = bin.triangles_in(column, row);
        if (triangles.empty()) continue;
        if (!is_cleared) clear(visibility);
        is_cleared = true;
        raster.see(bin, triangles);
    }
    return is_cleared;
}

void rasterize_behind(const ProjectedScene& scene, const TileVisibility& before, TileVisibility& visibility) {
    visibility.x0 = before.x0;
    visibility.y0 = before.y0;
    visibility.width = before.width;
    visibility.height = before.height;
    visibility.stride = before.stride;
    visibility.samples = before.samples;
    clear(visibility);
    TileRaster raster(scene, visibility, Limits{before.depth.data(), before.triangle.data()});
    for (const TriangleBin& bin : scene.bins)
        raster.see(bin, bin.triangles_in(before.x0 / scene.tile_size, before.y0 / scene.tile_size));
}

}  // namespace candela
