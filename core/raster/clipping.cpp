module;

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

module candela.raster;

import :bounds;
import :clipping;
import candela.api;

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

class Clipper {
  public:
    Clipper(const ProjectedScene& scene, std::vector<RasterTriangle>& pieces)
        : scene_(scene),
          pieces_(pieces),
          bounds_(scene),
          perspective_(scene.camera.projection == Projection::perspective),
          width_(static_cast<float>(scene.camera.width)),
          height_(static_cast<float>(scene.camera.height)),
          one_(static_cast<float>(1 << scene.subpixel_bits)) {}

    ClipVertex vertex(std::size_t i) const {
        const ProjectedVertex& v = scene_.vertices[i];
        if (perspective_) return {v.x, v.y, v.w, v.distance - scene_.near, 1};
        return {v.x, v.y, v.w, v.distance, -v.distance};
    }

    /// Sutherland, Hodgman (1974). An intersection is always computed from the inner end of an edge to the
    /// outer, so that both triangles at an edge are cut at the same point.
    void clip(const std::array<ClipVertex, 3>& triangle, std::uint32_t id, bool two_sided) {
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
        for (std::size_t i = 2; i < count; ++i) emit(polygon[0], polygon[i - 1], polygon[i], id);
    }

  private:
    // Clipping against the picture itself would be wasted work, because the rasteriser only visits the
    // picture's pixels; but the range of fixed-point coordinates is limited to half a picture outside each
    // edge.
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

    /// The vertices are counter-clockwise in the world if the triangle is seen from the front.
    void emit(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c, std::uint32_t id) {
        RasterTriangle piece{.vertex = {}, .id = id};
        std::size_t k = 0;
        for (const ClipVertex* const corner : {&a, &c, &b}) {
            const float inverse = 1 / corner->w;
            const float px = corner->x * inverse;
            const float py = corner->y * inverse;
            // Farther outside the guard band than rounding explains: the position was non-finite.
            if (!(std::abs(px - 0.5f * width_) <= 1.01f * width_ &&
                  std::abs(py - 0.5f * height_) <= 1.01f * height_))
                return;
            piece.vertex[k++] = {static_cast<std::int32_t>(std::lrint(px * one_)),
                                 static_cast<std::int32_t>(std::lrint(py * one_)), corner->depth_w * inverse,
                                 0};
        }
        auto& [first, second, third] = piece.vertex;
        const std::int64_t area = std::int64_t{second.x - first.x} * (third.y - first.y) -
                                  std::int64_t{third.x - first.x} * (second.y - first.y);
        if (area < 0) std::swap(second, third);
        const bool has_samples = !bounds_.misses(least(first.x, second.x, third.x),
                                                 most(first.x, second.x, third.x), bounds_.width) &&
                                 !bounds_.misses(least(first.y, second.y, third.y),
                                                 most(first.y, second.y, third.y), bounds_.height);
        if (area != 0 && has_samples) pieces_.push_back(piece);
    }

    const ProjectedScene& scene_;
    std::vector<RasterTriangle>& pieces_;
    SampleBounds bounds_;
    bool perspective_;
    float width_, height_, one_;
};

}  // namespace

void clip(const ProjectedScene& scene, const std::array<std::uint32_t, 3>& vertices, std::uint32_t id,
          bool two_sided, std::vector<RasterTriangle>& pieces) {
    Clipper clipper(scene, pieces);
    clipper.clip({clipper.vertex(vertices[0]), clipper.vertex(vertices[1]), clipper.vertex(vertices[2])}, id,
                 two_sided);
}

}  // namespace candela
