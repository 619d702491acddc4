// From world space to fixed-point triangles in tiles: transformation, culling, clipping, binning.
module;

#include "candela/multiversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

module candela.raster;

import candela.parallel;

namespace candela {

namespace {

/// What is nearer to the eye than a tenth of a millimetre is not seen (perspective only).
constexpr float k_near = 1e-4f;

constexpr std::size_t k_triangles_per_bin = 4096;
constexpr std::size_t k_vertices_per_task = 16384;

struct ProjectLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, ConstVec3Span position, std::size_t count, float* x,
                                       float* y, float* distance) {
        const Vec3 eye = camera.eye;
        const float scale = camera.pixels_per_unit;
        const float cx = 0.5f * static_cast<float>(camera.width);
        const float cy = 0.5f * static_cast<float>(camera.height);
        const bool perspective = camera.projection == Projection::perspective;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = position[i] - eye;
            const float along = dot(camera.forward, d);
            const float w = perspective ? along : 1.0f;
            x[i] = scale * dot(camera.right, d) + cx * w;
            y[i] = cy * w - scale * dot(camera.up, d);
            distance[i] = along;
        }
    }
};

/// A vertex in homogeneous pixels: it is seen at (x / w, y / w).
struct ClipVertex {
    float x, y, w;
    float ahead;  // distance in front of the near plane
    float
        closeness_w;  // closeness times w: 1 in perspective (1/w), minus the distance in an orthographic view
};

ClipVertex between(const ClipVertex& a, const ClipVertex& b, float t) {
    const auto mix = [t](float from, float to) { return from + t * (to - from); };
    return {mix(a.x, b.x), mix(a.y, b.y), mix(a.w, b.w), mix(a.ahead, b.ahead),
            mix(a.closeness_w, b.closeness_w)};
}

/// Twice the signed area in homogeneous pixels, times the product of the w: its sign is the triangle's
/// orientation on the screen, also where vertices lie behind the eye (Olano, Greer 1997).
double orientation(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c) {
    const double ax = a.x, ay = a.y, aw = a.w, bx = b.x, by = b.y, bw = b.w, cx = c.x, cy = c.y, cw = c.w;
    return ax * (by * cw - cy * bw) - ay * (bx * cw - cx * bw) + aw * (bx * cy - cx * by);
}

/// Makes the fixed-point triangles of one stretch of a mesh and sorts them into tiles.
class Binner {
  public:
    Binner(const ProjectedScene& scene, TriangleBin& bin)
        : scene_(scene),
          bin_(bin),
          perspective_(scene.camera.projection == Projection::perspective),
          width_(static_cast<float>(scene.camera.width)),
          height_(static_cast<float>(scene.camera.height)),
          one_(static_cast<float>(1 << scene.subpixel_bits)) {}

    void add(const Mesh& mesh, std::uint32_t first_vertex, std::size_t triangle, std::uint32_t id) {
        std::array<ClipVertex, 3> v;
        unsigned outside_all = ~0u;
        unsigned outside_any = 0;
        for (std::size_t k = 0; k < 3; ++k) {
            v[k] = vertex(first_vertex + mesh.corners[3 * triangle + k]);
            outside_all &= outside_view(v[k]);
            outside_any |= outside_guard(v[k]);
        }
        if (outside_all != 0) return;
        if (outside_any == 0) {
            emit(v[0], v[1], v[2], id, !mesh.closed);
        } else {
            clip_and_emit(v, id, !mesh.closed);
        }
    }

    void sort_into_tiles() {
        const int size = scene_.tile_size << scene_.subpixel_bits;
        struct Range {
            int column0, column1, row0, row1;
        };
        std::vector<Range> ranges;
        ranges.reserve(bin_.triangles.size());
        int column0 = scene_.tile_columns, column1 = -1, row0 = scene_.tile_rows, row1 = -1;
        for (const RasterTriangle& t : bin_.triangles) {
            const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
            const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
            const Range range{std::max(left, 0) / size, std::min(right / size, scene_.tile_columns - 1),
                              std::max(top, 0) / size, std::min(bottom / size, scene_.tile_rows - 1)};
            ranges.push_back(range);
            column0 = std::min(column0, range.column0);
            column1 = std::max(column1, range.column1);
            row0 = std::min(row0, range.row0);
            row1 = std::max(row1, range.row1);
        }
        if (ranges.empty()) return;
        bin_.first_column = column0;
        bin_.first_row = row0;
        bin_.columns = column1 - column0 + 1;
        bin_.rows = row1 - row0 + 1;
        // Counting sort, so that a tile's triangles stay in the scene's order.
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
        const float distance = scene_.distance[i];
        if (perspective_) return {scene_.x[i], scene_.y[i], distance, distance - k_near, 1};
        return {scene_.x[i], scene_.y[i], 1, distance, -distance};
    }

    /// A bit for each plane of the picture's pyramid or box that the vertex lies beyond.
    unsigned outside_view(const ClipVertex& v) const {
        return (v.ahead < 0 ? 1u : 0u) | (v.x < 0 ? 2u : 0u) | (v.x > width_ * v.w ? 4u : 0u) |
               (v.y < 0 ? 8u : 0u) | (v.y > height_ * v.w ? 16u : 0u);
    }

    // Clipping against the picture itself would be needless work, as the rasteriser looks at the picture's
    // pixels only; but fixed-point coordinates end somewhere: at half a picture beyond each edge.
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
    unsigned outside_guard(const ClipVertex& v) const {
        unsigned bits = 0;
        for (int plane = 0; plane < k_guard_planes; ++plane) bits |= beyond(v, plane) >= 0 ? 0u : 1u << plane;
        return bits;
    }

    /// Sutherland, Hodgman (1974). A cut point is always computed from the inner end of an edge to the outer,
    /// so that both triangles at an edge are cut at the same point.
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

    /// Counter-clockwise in the world, y up, is clockwise on the screen, y down.
    void emit(const ClipVertex& a, const ClipVertex& b, const ClipVertex& c, std::uint32_t id,
              bool two_sided) {
        RasterTriangle t{.x = {}, .y = {}, .closeness = {}, .id = id};
        const ClipVertex* const corners[3] = {&a, &c, &b};
        for (std::size_t k = 0; k < 3; ++k) {
            const float inverse = 1 / corners[k]->w;
            const float px = corners[k]->x * inverse;
            const float py = corners[k]->y * inverse;
            // Beyond the guard band by more than rounding: a number that was no number.
            if (!(std::abs(px - 0.5f * width_) <= 1.01f * width_ &&
                  std::abs(py - 0.5f * height_) <= 1.01f * height_))
                return;
            t.x[k] = static_cast<std::int32_t>(std::lrint(px * one_));
            t.y[k] = static_cast<std::int32_t>(std::lrint(py * one_));
            t.closeness[k] = corners[k]->closeness_w * inverse;
        }
        const std::int64_t area = std::int64_t{t.x[1] - t.x[0]} * (t.y[2] - t.y[0]) -
                                  std::int64_t{t.x[2] - t.x[0]} * (t.y[1] - t.y[0]);
        if (area == 0 || (area < 0 && !two_sided)) return;
        if (area < 0) {
            std::swap(t.x[1], t.x[2]);
            std::swap(t.y[1], t.y[2]);
            std::swap(t.closeness[1], t.closeness[2]);
        }
        // Nothing where no sample can be: the box lies beside the picture.
        const auto [left, right] = std::minmax({t.x[0], t.x[1], t.x[2]});
        const auto [top, bottom] = std::minmax({t.y[0], t.y[1], t.y[2]});
        if (right < 0 || bottom < 0 || left >= scene_.camera.width << scene_.subpixel_bits ||
            top >= scene_.camera.height << scene_.subpixel_bits) {
            return;
        }
        bin_.triangles.push_back(t);
    }

    const ProjectedScene& scene_;
    TriangleBin& bin_;
    bool perspective_;
    float width_, height_, one_;
};

struct Stretch {
    std::size_t mesh;
    std::size_t first;  // triangle of the mesh
    std::size_t count;
};

}  // namespace

ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size) {
    ProjectedScene scene;
    scene.camera = camera;
    scene.tile_size = tile_size;
    scene.tile_columns = (camera.width + tile_size - 1) / tile_size;
    scene.tile_rows = (camera.height + tile_size - 1) / tile_size;
    // Twice the picture's size, in fixed point, must leave room for 64 steps in 32 bits.
    scene.subpixel_bits = std::max(camera.width, camera.height) <= 8192 ? 8 : 4;

    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::vector<Stretch> stretches;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        scene.first_vertex.push_back(static_cast<std::uint32_t>(vertices));
        scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
        vertices += meshes[m]->vertex_count();
        triangles += meshes[m]->triangle_count();
        if (vertices >= k_no_triangle || triangles >= k_no_triangle) {
            throw std::length_error("the scene has more than 4294967294 triangles or vertices");
        }
        for (std::size_t first = 0; first < meshes[m]->triangle_count(); first += k_triangles_per_bin) {
            stretches.push_back(
                {m, first, std::min(k_triangles_per_bin, meshes[m]->triangle_count() - first)});
        }
    }
    scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));

    scene.x.resize(vertices);
    scene.y.resize(vertices);
    scene.distance.resize(vertices);
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        parallel_for(meshes[m]->vertex_count(), k_vertices_per_task, [&](std::size_t begin, std::size_t end) {
            const std::size_t at = scene.first_vertex[m] + begin;
            multiversion<ProjectLoop>(camera, meshes[m]->position.span().from(begin), end - begin,
                                      &scene.x[at], &scene.y[at], &scene.distance[at]);
        });
    }

    scene.bins.resize(stretches.size());
    parallel_for(stretches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const auto [m, first, count] = stretches[s];
            Binner binner(scene, scene.bins[s]);
            for (std::size_t t = first; t < first + count; ++t) {
                binner.add(*meshes[m], scene.first_vertex[m], t,
                           scene.first_triangle[m] + static_cast<std::uint32_t>(t));
            }
            binner.sort_into_tiles();
        }
    });
    return scene;
}

}  // namespace candela
