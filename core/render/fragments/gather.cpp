module;

#include "candela/multiversion.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

module candela.fragments;

import :interpolation;

namespace candela {

namespace {

/// Scales homogeneous coordinates that are so large, or so small, that products of two leave the range of
/// floats. By a power of two, so that nothing is rounded.
void keep_in_range(TriangleAttributes& t) {
    constexpr float k_largest_picture = 65536;
    constexpr float k_large = 0x1p40f;
    float largest = 0;
    for (const ProjectedVertex& v : t.projected)
        largest = std::max({largest, std::abs(v.x), std::abs(v.y), k_largest_picture * std::abs(v.w)});
    if (largest == 0 || (largest < k_large && largest > 1 / k_large)) return;
    const int exponent = -std::ilogb(largest);
    for (ProjectedVertex& v : t.projected) {
        for (float* const coordinate : {&v.x, &v.y, &v.w}) *coordinate = std::ldexp(*coordinate, exponent);
    }
}

using Indices = std::array<std::uint32_t, 3>;

Indices corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const std::size_t first = 3 * std::size_t{triangle};
    return {mesh.indices[first], mesh.indices[first + 1], mesh.indices[first + 2]};
}

using Corners = std::array<Vec3, 3>;

Corners indices(const Vec3Arrays& arrays, const Indices& vertices) {
    const ConstVec3Span span = arrays.span();
    return {span[vertices[0]], span[vertices[1]], span[vertices[2]]};
}

Vec3 blend(const Corners& c, const Vec3& weight) {
    return weight.x * c[0] + weight.y * c[1] + weight.z * c[2];
}

void resize(SurfacePoints& points, std::array<Vec3Arrays, 3> SurfacePoints::* corners) {
    for (Vec3Arrays& arrays : points.*corners) arrays.resize(k_batch_size + k_lanes);
}

/// The vertices of a triangle, at each of its points.
void repeat_corners(const Mesh& mesh, const Indices& vertices, std::size_t first, std::size_t count,
                    SurfacePoints& points) {
    if (points.corner_position[0].empty()) {
        resize(points, &SurfacePoints::corner_position);
        resize(points, &SurfacePoints::corner_normal);
    }
    const auto repeat = [&](Vec3Arrays& arrays, const Vec3& value) {
        std::fill_n(&arrays.x[first], count, value.x);
        std::fill_n(&arrays.y[first], count, value.y);
        std::fill_n(&arrays.z[first], count, value.z);
    };
    for (std::size_t k = 0; k < 3; ++k) {
        const MeshVertex& vertex = mesh.vertices[vertices[k]];
        repeat(points.corner_position[k], vertex.position);
        repeat(points.corner_normal[k], vertex.normal);
    }
}

/// Colour, uv, derivatives and triangle of points whose barycentric coordinates are known.
void blend_attributes(const Mesh& mesh, const Indices& vertices, PointNeeds needs, std::size_t first,
                      std::size_t count, SurfacePoints& points) {
    const ConstVec3Span weight = std::as_const(points.barycentric).span();
    if (needs.color) {
        const Corners color = indices(mesh.color, vertices);
        for (std::size_t i = first; i < first + count; ++i)
            points.color.span().set(i, blend(color, weight[i]));
    }
    if (needs.uv) {
        const bool has_uv = !mesh.u.empty();
        for (std::size_t i = first; i < first + count; ++i) {
            const auto mix = [&](const AlignedVector<float>& a) {
                return has_uv ? weight.x[i] * a[vertices[0]] + weight.y[i] * a[vertices[1]] +
                                    weight.z[i] * a[vertices[2]]
                              : 0.0f;
            };
            points.u[i] = mix(mesh.u);
            points.v[i] = mix(mesh.v);
        }
    }
    if (needs.derivatives) {
        Corners dpdu, dpdv;
        if (mesh.dpdu.empty()) {
            // A mesh without a parametrisation uses that of its triangles: the edges from the first vertex.
            const Corners p = indices(mesh.position, vertices);
            for (std::size_t k = 0; k < 3; ++k) {
                dpdu[k] = p[1] - p[0];
                dpdv[k] = p[2] - p[0];
            }
        } else {
            dpdu = indices(mesh.dpdu, vertices);
            dpdv = indices(mesh.dpdv, vertices);
        }
        for (std::size_t i = first; i < first + count; ++i) {
            points.dpdu.span().set(i, blend(dpdu, weight[i]));
            points.dpdv.span().set(i, blend(dpdv, weight[i]));
        }
    }
    if (needs.triangle) repeat_corners(mesh, vertices, first, count, points);
}

/// Evaluates point `i` of a batch, a position on a triangle.
void evaluate_point(const Mesh& mesh, std::uint32_t triangle, Vec3 weight, PointNeeds needs, std::size_t i,
                    SurfacePoints& points) {
    const Indices vertices = corners_of(mesh, triangle);
    const MeshVertex &a = mesh.vertices[vertices[0]], &b = mesh.vertices[vertices[1]],
                     &c = mesh.vertices[vertices[2]];
    points.position.span().set(i, blend({a.position, b.position, c.position}, weight));
    points.face_normal.span().set(i, mesh.face_normal.span()[triangle]);
    points.vertex_normal.span().set(i, blend({a.normal, b.normal, c.normal}, weight));
    points.barycentric.span().set(i, weight);
    if (needs.more()) blend_attributes(mesh, vertices, needs, i, 1, points);
}

}  // namespace

SurfacePoints::SurfacePoints() {
    // The whole vectors of a batch's last triangle may begin anywhere.
    for (Vec3Arrays* const arrays :
         {&position, &face_normal, &vertex_normal, &barycentric, &dpdu, &dpdv, &color}) {
        arrays->resize(k_batch_size + k_lanes);
    }
    for (AlignedVector<float>* const array : {&facing, &u, &v}) array->resize(k_batch_size + k_lanes);
}

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

TriangleAttributes attributes_of(const ProjectedMesh& source, std::uint32_t triangle) {
    const Indices vertices = corners_of(source.mesh, triangle);
    TriangleAttributes t;
    for (std::size_t k = 0; k < 3; ++k) {
        t.projected[k] = source.scene.vertices[source.first_vertex + vertices[k]];
        t.corner[k] = source.mesh.vertices[vertices[k]];
    }
    t.face_normal = source.mesh.face_normal.span()[triangle];
    if (!source.scene.is_moderate) keep_in_range(t);
    return t;
}

IndexedMesh indexed(const ProjectedMesh& source) {
    return {.indices = source.mesh.indices.data(),
            .projected = source.scene.vertices.data() + source.first_vertex,
            .vertices = source.mesh.vertices.data(),
            .face_normal = source.mesh.face_normal.span()};
}

/// Most runs of a fine mesh are one or two pixels long: writing a whole vector, and overwriting the excess
/// with the next run, takes less time than counting.
struct PlacesLoop {
    CANDELA_BATCH_LOOP static void run(const FragmentRun* runs, std::size_t count, float* x, float* y,
                                       std::uint32_t* triangle) {
        for (const FragmentRun* run = runs; run != runs + count; ++run) {
            for (std::size_t first = 0; first < run->count; first += k_lanes) {
                const float left = run->x + static_cast<float>(first);
                const float top = run->y;
                const std::uint32_t of = run->triangle;
                CANDELA_VECTORIZE_SIXTEEN
                for (std::size_t i = 0; i < k_lanes; ++i) {
                    x[first + i] = left + static_cast<float>(i);
                    y[first + i] = top;
                    triangle[first + i] = of;
                }
            }
            x += run->count;
            y += run->count;
            triangle += run->count;
        }
    }
};

/// The fragments of a batch: their positions and triangles. The last one is repeated, to pad the batch and
/// because whole vectors that begin anywhere reach beyond its end.
struct Places {
    static constexpr std::size_t k_behind = 2 * k_lanes;

    alignas(64) std::array<float, k_batch_size + k_behind> x, y;
    alignas(64) std::array<std::uint32_t, k_batch_size + k_behind> triangle;
    std::size_t count = 0;

    Places(const Mesh& mesh, std::span<const FragmentRun> runs, Interpolated what) {
        for (const FragmentRun& run : runs) {
            count += run.count;
            // All at once, because in a large mesh they come from far apart.
            __builtin_prefetch(&mesh.indices[3 * std::size_t{run.triangle}]);
            if (what != Interpolated::all) continue;
            __builtin_prefetch(&mesh.face_normal.x[run.triangle]);
            __builtin_prefetch(&mesh.face_normal.y[run.triangle]);
            __builtin_prefetch(&mesh.face_normal.z[run.triangle]);
        }
        multiversion<PlacesLoop>(runs.data(), runs.size(), x.data(), y.data(), triangle.data());
        std::fill_n(&x[count], k_behind, x[count - 1]);
        std::fill_n(&y[count], k_behind, y[count - 1]);
        std::fill_n(&triangle[count], k_behind, triangle[count - 1]);
    }
};

/// Calls `visit(triangle, first, end)` for each triangle's fragments, which are adjacent in a batch; the last
/// triangle's end where the padding ends.
template <class Visit>
void each_triangle(std::span<const FragmentRun> runs, std::size_t filled, Visit visit) {
    std::size_t first = 0;
    for (std::size_t run = 0; run < runs.size();) {
        const std::uint32_t triangle = runs[run].triangle;
        std::size_t end = first;
        for (; run < runs.size() && runs[run].triangle == triangle; ++run) end += runs[run].count;
        visit(triangle, first, run == runs.size() ? filled : end);
        first = end;
    }
}

/// Pads a batch that was assembled point by point with its last point.
void fill_up(PointNeeds needs, SurfacePoints& points) {
    points.filled = whole_vectors(points.count);
    const auto fill = [&](AlignedVector<float>& array) {
        std::fill(&array[points.count], &array[points.filled], array[points.count - 1]);
    };
    const auto fill_all = [&](Vec3Arrays& arrays) {
        fill(arrays.x);
        fill(arrays.y);
        fill(arrays.z);
    };
    fill_all(points.position);
    fill_all(points.face_normal);
    fill_all(points.vertex_normal);
    fill_all(points.barycentric);
    fill(points.facing);
    if (needs.color) fill_all(points.color);
    if (needs.uv) {
        fill(points.u);
        fill(points.v);
    }
    if (needs.derivatives) {
        fill_all(points.dpdu);
        fill_all(points.dpdv);
    }
    if (needs.triangle) {
        for (Vec3Arrays& arrays : points.corner_position) fill_all(arrays);
        for (Vec3Arrays& arrays : points.corner_normal) fill_all(arrays);
    }
}

Interpolated interpolated_for(PointNeeds needs) {
    if (needs.face_normal || needs.color || needs.uv || needs.derivatives) return Interpolated::all;
    const bool has_points = needs.position || needs.vertex_normal;
    if (needs.barycentric) return has_points ? Interpolated::all : Interpolated::barycentric;
    return Interpolated::position_and_normal;
}

/// From this many fragments on, a triangle is worth a loop of its own.
constexpr std::size_t k_worth_a_loop = 16;

}  // namespace

void gather_fragments(const ProjectedMesh& source, std::span<const FragmentRun> runs, PointNeeds needs,
                      SurfacePoints& points) {
    points.has_color = needs.color = needs.color && !source.mesh.color.empty();
    const Interpolated what = interpolated_for(needs);
    const Places places(source.mesh, runs, what);
    points.count = places.count;
    points.filled = whole_vectors(places.count);
    const auto spans_from = [&](std::size_t first) -> InterpolatedSpans {
        return {points.barycentric.span().from(first), points.position.span().from(first),
                points.vertex_normal.span().from(first), points.face_normal.span().from(first)};
    };
    std::size_t interpolated = 0;
    const auto fetch_up_to = [&](std::size_t end) {
        if (end == interpolated) return;
        interpolate_each(what, indexed(source), end - interpolated, &places.triangle[interpolated],
                         &places.x[interpolated], &places.y[interpolated], spans_from(interpolated));
        interpolated = end;
    };
    each_triangle(runs, points.filled, [&](std::uint32_t triangle, std::size_t first, std::size_t end) {
        if (source.scene.is_moderate && end - first < k_worth_a_loop) return;
        fetch_up_to(first);
        interpolate(what, attributes_of(source, triangle), end - first, &places.x[first], &places.y[first],
                    spans_from(first));
        interpolated = end;
    });
    fetch_up_to(points.filled);

    points.any_from_behind = false;
    std::fill_n(points.facing.begin(), points.filled, 1.0f);
    if (source.mesh.closed && !needs.more()) return;
    each_triangle(runs, points.filled, [&](std::uint32_t triangle, std::size_t first, std::size_t end) {
        if (source.is_back(triangle)) {
            points.any_from_behind = true;
            std::fill(points.facing.begin() + static_cast<std::ptrdiff_t>(first),
                      points.facing.begin() + static_cast<std::ptrdiff_t>(end), -1.0f);
        }
        if (needs.more())
            blend_attributes(source.mesh, corners_of(source.mesh, triangle), needs, first, end - first,
                             points);
    });
}

void gather_faces(const ProjectedMesh& source, std::span<const std::uint32_t> triangles, PointNeeds needs,
                  SurfacePoints& points) {
    constexpr float k_third = 1.0f / 3.0f;
    points.has_color = needs.color = needs.color && !source.mesh.color.empty();
    points.count = triangles.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        evaluate_point(source.mesh, triangles[i], {k_third, k_third, k_third}, needs, i, points);
        const bool is_back = source.is_back(triangles[i]);
        points.facing[i] = is_back ? -1.0f : 1.0f;
        points.any_from_behind = points.any_from_behind || is_back;
    }
    fill_up(needs, points);
}

void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles, ConstVec3Span barycentric,
                   PointNeeds needs, SurfacePoints& points) {
    points.has_color = needs.color = needs.color && !mesh.color.empty();
    points.count = points.filled = triangles.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        evaluate_point(mesh, triangles[i], barycentric[i], needs, i, points);
        points.facing[i] = 1;
    }
}

void gather_vertices(const ProjectedMesh& source, std::span<const VertexSide> vertices, PointNeeds needs,
                     SurfacePoints& points) {
    const Mesh& mesh = source.mesh;
    needs.triangle = false;
    points.has_color = needs.color = needs.color && !mesh.color.empty();
    points.count = vertices.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i].vertex;
        const Vec3 normal = mesh.vertices[v].normal;
        points.position.span().set(i, mesh.position.span()[v]);
        points.face_normal.span().set(i, normal);
        points.vertex_normal.span().set(i, normal);
        points.barycentric.span().set(i, {1, 0, 0});
        points.facing[i] = vertices[i].is_back ? -1.0f : 1.0f;
        points.any_from_behind = points.any_from_behind || vertices[i].is_back;
        if (needs.color) points.color.span().set(i, mesh.color.span()[v]);
        if (needs.uv) {
            points.u[i] = mesh.u.empty() ? 0 : mesh.u[v];
            points.v[i] = mesh.v.empty() ? 0 : mesh.v[v];
        }
        if (needs.derivatives) {
            points.dpdu.span().set(i, mesh.dpdu.empty() ? Vec3{} : mesh.dpdu.span()[v]);
            points.dpdv.span().set(i, mesh.dpdv.empty() ? Vec3{} : mesh.dpdv.span()[v]);
        }
    }
    fill_up(needs, points);
}

}  // namespace candela
