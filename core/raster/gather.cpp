module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

module candela.raster;

import :attributes;
import :interpolation;
import candela.util;

namespace candela {

namespace {

/// Scales homogeneous coordinates that are so large or so small that products of two leave the range of
/// floats. The factor is a power of two, so that nothing is rounded.
void keep_in_range(TriangleAttributes& t) {
    constexpr float k_largest_image = 65536;
    constexpr float k_large = 0x1p40f;
    float largest = 0;
    for (const ProjectedVertex& v : t.projected)
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), k_largest_image * std::abs(v.w)});
    if (largest == 0 || (largest < k_large && largest > 1 / k_large)) return;
    const int exponent = -std::ilogb(largest);
    for (ProjectedVertex& v : t.projected) {
        for (float* const coordinate : {&v.x, &v.y, &v.w}) *coordinate = std::ldexp(*coordinate, exponent);
    }
}

}  // namespace

bool ProjectedMesh::is_back(std::uint32_t triangle) const {
    if (mesh.closed) return false;
    const Indices vertices = corners_of(mesh, triangle);
    double x[3], y[3], w[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const ProjectedVertex& v = scene.vertices[first_vertex + vertices[k]];
        x[k] = v.x;
        y[k] = v.y;
        w[k] = v.w;
    }
    // Twice the signed area, y down: the front is counter-clockwise with y up.
    return x[0] * (y[1] * w[2] - y[2] * w[1]) - y[0] * (x[1] * w[2] - x[2] * w[1]) +
               w[0] * (x[1] * y[2] - x[2] * y[1]) >
           0;
}

namespace {

/// A mesh's texture coordinates: the first ones, or the second.
struct CoordinateSet {
    const AlignedVector<float>*u, *v;

    static CoordinateSet first(const Mesh& mesh) { return {&mesh.u, &mesh.v}; }
    static CoordinateSet second(const Mesh& mesh) { return {&mesh.channels[0], &mesh.channels[1]}; }
};

TriangleAttributes attributes_of(const ProjectedMesh& source, const CoordinateSet& uv,
                                 std::uint32_t triangle) {
    const Indices vertices = corners_of(source.mesh, triangle);
    TriangleAttributes t;
    for (std::size_t k = 0; k < 3; ++k) {
        t.projected[k] = source.scene.vertices[source.first_vertex + vertices[k]];
        t.corner[k] = source.mesh.vertices[vertices[k]];
    }
    t.face_normal = source.mesh.face_normal.span()[triangle];
    for (std::size_t k = 0; k < 3 && !uv.u->empty(); ++k) {
        t.u[k] = (*uv.u)[vertices[k]];
        t.v[k] = (*uv.v)[vertices[k]];
    }
    if (!source.scene.is_moderate) keep_in_range(t);
    return t;
}

IndexedMesh indexed(const ProjectedMesh& source, const CoordinateSet& uv) {
    return {.indices = source.mesh.indices.data(),
            .projected = source.scene.vertices.data() + source.first_vertex,
            .vertices = source.mesh.vertices.data(),
            .face_normal = source.mesh.face_normal.span(),
            .uv = {uv.u->data(), uv.v->data()}};
}

/// Whole vectors are written; the next run overwrites the excess.
struct PixelPositionLoop {
    CANDELA_BATCH_LOOP static void run(const FragmentRun* runs, std::size_t count, float* x, float* y) {
        for (const FragmentRun* run = runs; run != runs + count; ++run) {
            for (std::size_t first = 0; first < run->count; first += k_lanes) {
                const float left = run->x + static_cast<float>(first);
                const float top = run->y;
                CANDELA_VECTORIZE_SIXTEEN
                for (std::size_t i = 0; i < k_lanes; ++i) {
                    x[first + i] = left + static_cast<float>(i);
                    y[first + i] = top;
                }
            }
            x += run->count;
            y += run->count;
        }
    }
};

/// The pixels in whose middle fragments are.
struct PixelLoop {
    CANDELA_BATCH_LOOP static void run(const float* x, const float* y, std::size_t count, std::uint32_t* to_x,
                                       std::uint32_t* to_y) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            to_x[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(x[i]));
            to_y[i] = static_cast<std::uint32_t>(static_cast<std::int32_t>(y[i]));
        }
    }
};

/// The bits in which triangles differ from the first one, vector by vector.
struct DifferencesLoop {
    CANDELA_BATCH_LOOP static void run(const std::uint32_t* triangle, std::size_t count,
                                       std::uint32_t* differing) {
        for (std::size_t first = 0; first < count; first += k_lanes) {
            const std::uint32_t* const of = triangle + first;
            const std::uint32_t at_first = of[0];
            std::uint32_t bits = 0;
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t i = 0; i < k_lanes; ++i) bits |= of[i] ^ at_first;
            differing[first / k_lanes] = bits;
        }
    }
};

/// The fragments of a batch: their positions and triangles. The last one is repeated, to pad the batch and
/// because whole vectors that begin anywhere reach past its end.
struct PixelPositions {
    static constexpr std::size_t k_behind = 2 * k_lanes;

    alignas(64) std::array<float, k_batch_size + k_behind> x, y;
    bool is_one_triangle = false;  // all of them are on one triangle; then the following is not filled
    alignas(64) std::array<std::uint32_t, k_batch_size + k_behind> triangle;
    alignas(64) std::array<std::uint32_t, k_batch_size / k_lanes> differing;

    explicit PixelPositions(const FragmentBatch& batch) {
        const std::size_t count = batch.triangles.size();
        multiversion<PixelPositionLoop>(batch.runs.data(), batch.runs.size(), x.data(), y.data());
        std::fill_n(&x[count], k_behind, x[count - 1]);
        std::fill_n(&y[count], k_behind, y[count - 1]);
        is_one_triangle = are_all_equal(batch.triangles);
        if (is_one_triangle) return;
        std::ranges::copy(batch.triangles, triangle.begin());
        std::fill_n(&triangle[count], k_behind, triangle[count - 1]);
        multiversion<DifferencesLoop>(std::as_const(triangle).data(), whole_vectors(count), differing.data());
    }

    /// Whether the vector from `first` on is on one triangle.
    bool is_on_one(std::size_t first) const { return differing[first / k_lanes] == 0; }

    /// All at once, because in a large mesh they are far apart.
    void prefetch(const Mesh& mesh, std::size_t first, Interpolated what) const {
        for (std::size_t i = first; i < first + k_lanes; ++i) {
            __builtin_prefetch(&mesh.indices[3 * std::size_t{triangle[i]}]);
            if (!has_faces(what)) continue;
            __builtin_prefetch(&mesh.face_normal.x[triangle[i]]);
            __builtin_prefetch(&mesh.face_normal.y[triangle[i]]);
            __builtin_prefetch(&mesh.face_normal.z[triangle[i]]);
        }
    }
};

/// Calls `visit(triangle, first, end)` for each run of `triangles` on one triangle; the last run ends with
/// the padding.
template <class Visit>
void each_triangle(std::span<const std::uint32_t> triangles, std::size_t filled, Visit visit) {
    for (std::size_t first = 0; first < triangles.size();) {
        std::size_t end = first + 1;
        while (end < triangles.size() && triangles[end] == triangles[first]) ++end;
        visit(triangles[first], first, end == triangles.size() ? filled : end);
        first = end;
    }
}

/// For a mesh without texture coordinates.
void clear_uv(SurfacePoints& points) {
    for (AlignedVector<float>* const array :
         {&points.u, &points.v, &points.dudx, &points.dvdx, &points.dudy, &points.dvdy})
        std::ranges::fill(*array, 0.0f);
}

Interpolated interpolated_for(PointNeeds needs) {
    const bool has_points = needs.position || needs.vertex_normal || needs.uv;
    if (needs.face_normal || needs.color || needs.derivatives || needs.channels ||
        (needs.barycentric && has_points))
        return needs.uv ? Interpolated::all : Interpolated::all_but_uv;
    if (needs.barycentric) return Interpolated::barycentric;
    return needs.uv ? Interpolated::position_and_normal_and_uv : Interpolated::position_and_normal;
}

/// Barycentric coordinates of a batch's fragments and everything derived from them, vector by vector:
/// fragments on one triangle read it once, in other vectors each fragment reads its own.
class BatchInterpolation {
  public:
    BatchInterpolation(const ProjectedMesh& source, const PixelPositions& positions, Interpolated what,
                       SurfacePoints& points)
        : source_(source),
          places_(positions),
          what_(what),
          uv_(CoordinateSet::first(source.mesh)),
          points_(points) {}

    /// Only the second texture coordinates.
    static BatchInterpolation second_uv(const ProjectedMesh& source, const PixelPositions& positions,
                                        SurfacePoints& points) {
        BatchInterpolation result(source, positions, Interpolated::uv, points);
        result.uv_ = CoordinateSet::second(source.mesh);
        return result;
    }

    void run(std::span<const std::uint32_t> triangles) {
        if (places_.is_one_triangle) {
            on_one_triangle(triangles[0], 0, points_.filled);
        } else if (source_.scene.is_moderate) {
            on_triangles();
        } else {
            // Each triangle has its own scale.
            each_triangle(triangles, points_.filled,
                          [&](std::uint32_t triangle, std::size_t first, std::size_t end) {
                              on_one_triangle(triangle, first, end);
                          });
        }
    }

  private:
    void on_triangles() {
        for (std::size_t first = 0; first < points_.filled; first += k_lanes) {
            if (!places_.is_on_one(first)) places_.prefetch(source_.mesh, first, what_);
        }
        for (std::size_t first = 0; first < points_.filled;) {
            const bool is_one = places_.is_on_one(first);
            const std::uint32_t triangle = places_.triangle[first];
            std::size_t end = first + k_lanes;
            while (end < points_.filled && places_.is_on_one(end) == is_one &&
                   (!is_one || places_.triangle[end] == triangle))
                end += k_lanes;
            if (is_one) {
                on_one_triangle(triangle, first, end);
            } else {
                interpolate_each(what_, indexed(source_, uv_), end - first, &places_.triangle[first],
                                 &places_.x[first], &places_.y[first], spans_from(first));
            }
            first = end;
        }
    }

    void on_one_triangle(std::uint32_t triangle, std::size_t first, std::size_t end) {
        interpolate(what_, attributes_of(source_, uv_, triangle), end - first, &places_.x[first],
                    &places_.y[first], spans_from(first));
    }

    InterpolatedSpans spans_from(std::size_t first) {
        const bool is_second = what_ == Interpolated::uv;
        auto& second = points_.second_footprint;
        const auto span = [&](AlignedVector<float>& u, AlignedVector<float>& v) {
            return Vec2Span{u.data(), v.data()}.from(first);
        };
        return {points_.barycentric.span().from(first),
                points_.position.span().from(first),
                points_.vertex_normal.span().from(first),
                points_.face_normal.span().from(first),
                is_second ? span(points_.channels[0], points_.channels[1]) : span(points_.u, points_.v),
                is_second ? span(second[0], second[1]) : span(points_.dudx, points_.dvdx),
                is_second ? span(second[2], second[3]) : span(points_.dudy, points_.dvdy)};
    }

    const ProjectedMesh& source_;
    const PixelPositions& places_;
    Interpolated what_;
    CoordinateSet uv_;
    SurfacePoints& points_;
};

}  // namespace

void gather_fragments(const ProjectedMesh& source, const FragmentBatch& batch, PointNeeds needs,
                      SurfacePoints& points) {
    points.has_color = needs.color = needs.color && !source.mesh.color.empty();
    points.count = batch.triangles.size();
    points.filled = whole_vectors(points.count);
    if (needs.uv && source.mesh.u.empty()) {
        clear_uv(points);
        needs.uv = false;
    }
    take_channels(source.mesh, needs, points);
    const bool is_faceted = source.mesh.is_faceted && needs.vertex_normal;
    needs.face_normal = needs.face_normal || is_faceted;
    const PixelPositions positions(batch);
    BatchInterpolation(source, positions, interpolated_for(needs), points).run(batch.triangles);
    const std::size_t blended = needs.channels && source.mesh.has_second_uv ? 2 : 0;
    if (blended > 0) BatchInterpolation::second_uv(source, positions, points).run(batch.triangles);
    if (is_faceted) {
        const ConstVec3Span from = std::as_const(points.face_normal).span();
        const Vec3Span to = points.vertex_normal.span();
        std::copy_n(from.x, points.filled, to.x);
        std::copy_n(from.y, points.filled, to.y);
        std::copy_n(from.z, points.filled, to.z);
    }

    if (needs.pixel) {
        const float* const x = positions.x.data();
        const float* const y = positions.y.data();
        multiversion<PixelLoop>(x, y, points.filled, points.pixel_x.data(), points.pixel_y.data());
        auto to = points.coverage.begin();
        for (const FragmentRun& run : batch.runs) to = std::fill_n(to, run.count, run.weight);
        std::fill(to, points.coverage.begin() + static_cast<std::ptrdiff_t>(points.filled), 0.0f);
    }
    set_triangles(needs, batch.triangles, points);
    face_forward(points);
    needs.uv = false;
    if (source.mesh.closed && !needs.more()) return;
    each_triangle(batch.triangles, points.filled,
                  [&](std::uint32_t triangle, std::size_t first, std::size_t end) {
                      if (source.is_back(triangle)) {
                          points.any_from_behind = true;
                          std::fill(points.facing.begin() + static_cast<std::ptrdiff_t>(first),
                                    points.facing.begin() + static_cast<std::ptrdiff_t>(end), -1.0f);
                      }
                      if (!needs.more()) return;
                      const Indices vertices = corners_of(source.mesh, triangle);
                      blend_attributes(source.mesh, vertices, needs, first, end - first, points);
                      if (needs.channels)
                          blend_channels(source.mesh, vertices, blended, first, end - first, points);
                  });
}

}  // namespace candela
