module;

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

module candela.raster;

import :binning;
import candela.transform;

namespace candela {

namespace {

/// A vertex in homogeneous pixels: on the screen at (x / w, y / w).
struct ClipVertex {
    float x, y, w;
    float ahead;    // distance in front of the near plane
    float depth_w;  // depth times w: 1 in perspective (1/w), minus the distance in an orthographic view
};

ClipVertex between(const ClipVertex& a, const ClipVertex& b, float t) {
    const auto mix = [t](float from, float to) { return from + t * (to - from); };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.w, b.w), mix(a.ahead, b.ahead), mix(a.depth_w, b.depth_w)};
}

/// Twice the signed area in homogeneous pixels, times the product of the w: its sign is the triangle's
/// orientation on the screen, even if vertices lie behind the eye (Olano, Greer 1997).
double orientation(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    const double ax = a.x, ay = a.y, aw = a.w, bx = b.x, by = b.y, bw = b.w, cx = c.x, cy = c.y, cw = c.w;
    return ax * (by * cw - cy * bw) - ay * (bx * cw - cx * bw) + aw * (bx * cy - cx * by);
}

/// Makes the fixed-point triangles of one range of a mesh and sorts them into tiles.
class Binner {
  public:
    Binner(const ProjectedScene& scene, TriangleBin& bin)
        : scene_(scene),
          bin_(bin),
          perspective_(scene.camera.projection == Projection::perspective),
          width_(static_cast<float>(scene.camera.width)),
          height_(static_cast<float>(scene.camera.height)),
          one_(static_cast<float>(1 << scene.subpixel_bits)) {
        bin_.triangles.clear();
        bin_.entries.clear();
        bin_.columns = bin_.rows = 0;
    }

    void add(const std::uint32_t* indices, std::uint32_t first_vertex, std::uint32_t id, bool two_sided) {
        const ScreenVertex* const screen = scene_.screen.data() + first_vertex;
        // Counter-clockwise in the world, y up, is clockwise on the screen, y down.
        const ScreenVertex& a = screen[indices[0]];
        const ScreenVertex& b = screen[indices[2]];
        const ScreenVertex& c = screen[indices[1]];
        if ((a.outside & b.outside & c.outside & Outside::view) != 0) return;
        const std::uint32_t outside = a.outside | b.outside | c.outside;
        if ((outside & Outside::guard) != 0) {
            const auto at = [&](std::size_t k) { return vertex(first_vertex + indices[k]); };
            clip_and_emit({at(0), at(1), at(2)}, id, two_sided);
        } else if ((outside & Outside::nowhere) == 0) {
            emit(a, b, c, id, two_sided);
        }
    }

    void sort_into_tiles() {
        const int bits = scene_.subpixel_bits + std::countr_zero(static_cast<unsigned>(scene_.tile_size));
        struct Range {
            std::int16_t column0, column1, row0, row1;
        };
        std::vector<Range> ranges;
        ranges.reserve(bin_.triangles.size());
        int column0 = scene_.tile_columns, column1 = -1, row0 = scene_.tile_rows, row1 = -1;
        for (const RasterTriangle& t : bin_.triangles) {
            const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
            const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
            const Range range{static_cast<std::int16_t>(std::max(left, 0) >> bits),
                              static_cast<std::int16_t>(std::min(right >> bits, scene_.tile_columns - 1)),
                              static_cast<std::int16_t>(std::max(top, 0) >> bits),
                              static_cast<std::int16_t>(std::min(bottom >> bits, scene_.tile_rows - 1))};
            ranges.push_back(range);
            column0 = std::min<int>(column0, range.column0);
            column1 = std::max<int>(column1, range.column1);
            row0 = std::min<int>(row0, range.row0);
            row1 = std::max<int>(row1, range.row1);
        }
        if (ranges.empty()) return;
        bin_.first_column = column0;
        bin_.first_row = row0;
        bin_.columns = column1 - column0 + 1;
        bin_.rows = row1 - row0 + 1;
        // A counting sort keeps a tile's triangles in the scene's order.
        bin_.start.assign(static_cast<std::size_t>(bin_.columns) * static_cast<std::size_t>(bin_.rows) + 1,
                          0);
        const auto each_tile = [&](const Range& range, auto&& visit) {
            for (int row = range.row0; row <= range.row1; ++row) {
                for (int column = range.column0; column <= range.column1; ++column) {
                    visit(static_cast<std::size_t>((row - row0) * bin_.columns + column - column0));
                }
            }
        };
        for (const Range& range : ranges) {
            each_tile(range, [&](std::size_t tile) { ++bin_.start[tile + 1]; });
        }
        for (std::size_t tile = 1; tile < bin_.start.size(); ++tile) bin_.start[tile] += bin_.start[tile - 1];
        bin_.entries.resize(bin_.start.back());
        std::vector<std::uint32_t> next(bin_.start.begin(), bin_.start.end() - 1);
        for (std::size_t i = 0; i < ranges.size(); ++i) {
            each_tile(ranges[i],
                      [&](std::size_t tile) { bin_.entries[next[tile]++] = static_cast<std::uint32_t>(i); });
        }
    }

  private:
    ClipVertex vertex(std::size_t i) const {
        const ProjectedVertex& v = scene_.vertices[i];
        if (perspective_) return {v.x, v.y, v.w, v.distance - scene_.near, 1};
        return {v.x, v.y, v.w, v.distance, -v.distance};
    }

    // Clipping against the picture itself would be wasted work, because the rasteriser only visits the
    // picture's pixels; but fixed-point coordinates are limited, to half a picture beyond each edge.
    static constexpr int k_guard_planes = 5;
    float beyond(const ClipVertex& v, int plane) const {
        switch (plane) {
            case 0:
                return v.ahead;
            case 1:
                return v.x + 0.5f * width_ * v.w;
            case 2:
                return 1.5f * width_ * v.w - v.x;
            case 3:
                return v.y + 0.5f * height_ * v.w;
            default:
                return 1.5f * height_ * v.w - v.y;
        }
    }
    /// Sutherland, Hodgman (1974). An intersection is always computed from the inner end of an edge to the
    /// outer, so that both triangles at an edge are cut at the same point.
    void clip_and_emit(const std::array<ClipVertex, 3>& triangle, std::uint32_t id, bool two_sided) {
        const bool is_front = orientation(triangle[0], triangle[1], triangle[2]) < 0;
        if (!is_front && !two_sided) return;
        std::array<ClipVertex, 3 + k_guard_planes> polygon{}, cut{};
        std::ranges::copy(triangle, polygon.begin());
        std::size_t count = 3;
        for (int plane = 0; plane < k_guard_planes; ++plane) {
            std::size_t kept = 0;
            for (std::size_t i = 0; i < count; ++i) {
                const ClipVertex& a = polygon[i];
                const ClipVertex& b = polygon[i + 1 == count ? 0 : i + 1];
                const float at_a = beyond(a, plane);
                const float at_b = beyond(b, plane);
                if (at_a >= 0) cut[kept++] = a;
                if (at_a >= 0 && !(at_b >= 0)) cut[kept++] = between(a, b, at_a / (at_a - at_b));
                if (at_b >= 0 && !(at_a >= 0)) cut[kept++] = between(b, a, at_b / (at_b - at_a));
            }
            polygon = cut;
            count = kept;
            if (count < 3) return;
        }
        for (std::size_t i = 2; i < count; ++i) emit(polygon[0], polygon[i - 1], polygon[i], id, true);
    }

    void emit(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c, std::uint32_t id,
              bool two_sided) {
        std::array<ScreenVertex, 3> indices{};
        std::size_t k = 0;
        for (const ClipVertex* const corner : {&a, &c, &b}) {
            const float inverse = 1 / corner->w;
            const float px = corner->x * inverse;
            const float py = corner->y * inverse;
            // Beyond the guard band by more than rounding: the position was not finite.
            if (!(std::abs(px - 0.5f * width_) <= 1.01f * width_ &&
                  std::abs(py - 0.5f * height_) <= 1.01f * height_))
                return;
            indices[k++] = {static_cast<std::int32_t>(std::lrint(px * one_)),
                            static_cast<std::int32_t>(std::lrint(py * one_)), corner->depth_w * inverse, 0};
        }
        emit(indices[0], indices[1], indices[2], id, two_sided);
    }

    /// The vertices are clockwise, y down, if the triangle is seen from the front.
    void emit(const ScreenVertex& a, const ScreenVertex& b, const ScreenVertex& c, std::uint32_t id,
              bool two_sided) {
        const std::int64_t area =
            std::int64_t{b.x - a.x} * (c.y - a.y) - std::int64_t{c.x - a.x} * (b.y - a.y);
        if (area == 0 || (area < 0 && !two_sided)) return;
        const auto [left, right] = std::minmax({a.x, b.x, c.x});
        const auto [top, bottom] = std::minmax({a.y, b.y, c.y});
        if (misses_samples(left, right, scene_.camera.width) ||
            misses_samples(top, bottom, scene_.camera.height))
            return;
        const ScreenVertex& second = area > 0 ? b : c;
        const ScreenVertex& third = area > 0 ? c : b;
        bin_.triangles.push_back({.x = {a.x, second.x, third.x},
                                  .y = {a.y, second.y, third.y},
                                  .depth = {a.depth, second.depth, third.depth},
                                  .id = id});
    }

    /// Whether no sample can be between the two, the ends of a box along one axis of a picture of `size`
    /// pixels.
    bool misses_samples(std::int32_t low, std::int32_t high, int size) const {
        if (high < 0 || low >= size << scene_.subpixel_bits) return true;
        if (scene_.samples > 1) return false;
        const std::int32_t half = 1 << (scene_.subpixel_bits - 1);
        return (low + half - 1) >> scene_.subpixel_bits == (high + half) >> scene_.subpixel_bits;
    }

    const ProjectedScene& scene_;
    TriangleBin& bin_;
    bool perspective_;
    float width_, height_, one_;
};

}  // namespace

void bin_triangles(const ProjectedScene& scene, const Mesh& mesh, std::uint32_t first_vertex,
                   std::uint32_t first_id, std::size_t first_triangle, std::size_t count, TriangleBin& bin) {
    Binner binner(scene, bin);
    const std::uint32_t* const indices = mesh.indices.data();
    for (std::size_t t = first_triangle; t < first_triangle + count; ++t)
        binner.add(indices + 3 * t, first_vertex, first_id + static_cast<std::uint32_t>(t), !mesh.closed);
    binner.sort_into_tiles();
}

}  // namespace candela
