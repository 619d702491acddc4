// Attributes of faces, vertices and fragments.
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

namespace candela {

namespace {

/// Where one attribute stands in memory, for each corner of a triangle.
struct Corners {
    Vec3 at[3];
};

/// A triangle in homogeneous pixels, and its corners' attributes.
struct TriangleAttributes {
    float x[3], y[3], w[3];
    Corners position;
    Corners normal;
};

struct PointSpans {
    Vec3Span barycentric, position, vertex_normal;
};

[[gnu::always_inline]] inline Vec3 blend(const Corners& c, float b0, float b1, float b2) {
    return {b0 * c.at[0].x + b1 * c.at[1].x + b2 * c.at[2].x,
            b0 * c.at[0].y + b1 * c.at[1].y + b2 * c.at[2].y,
            b0 * c.at[0].z + b1 * c.at[1].z + b2 * c.at[2].z};
}

/// Scales homogeneous coordinates that are so large, or so small, that products of two leave the range of
/// floats. By a power of two, so that nothing is rounded.
void keep_in_range(TriangleAttributes& t) {
    constexpr float k_largest_picture = 65536;
    constexpr float k_large = 0x1p40f;
    float largest = 0;
    for (std::size_t k = 0; k < 3; ++k)
        largest =
            std::max({largest, std::abs(t.x[k]), std::abs(t.y[k]), k_largest_picture * std::abs(t.w[k])});
    if (largest == 0 || (largest < k_large && largest > 1 / k_large)) return;
    const int exponent = -std::ilogb(largest);
    for (std::size_t k = 0; k < 3; ++k) {
        for (float* const coordinate : {&t.x[k], &t.y[k], &t.w[k]})
            *coordinate = std::ldexp(*coordinate, exponent);
    }
}

/// A run of fragments of one triangle.
struct RunLoop {
    CANDELA_BATCH_LOOP static void run(TriangleAttributes t, std::size_t count, const float* px,
                                       const float* py, PointSpans out) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            // Corners relative to the fragment; areas of the three part triangles, perspective already undone
            // by w.
            const float x0 = t.x[0] - px[i] * t.w[0], y0 = t.y[0] - py[i] * t.w[0];
            const float x1 = t.x[1] - px[i] * t.w[1], y1 = t.y[1] - py[i] * t.w[1];
            const float x2 = t.x[2] - px[i] * t.w[2], y2 = t.y[2] - py[i] * t.w[2];
            float b0 = x1 * y2 - x2 * y1;
            float b1 = x2 * y0 - x0 * y2;
            float b2 = x0 * y1 - x1 * y0;
            // On the triangle, also where its fixed-point image reaches a hair further than the triangle.
            const float sign = b0 + b1 + b2 < 0.0f ? -1.0f : 1.0f;
            b0 = b0 * sign > 0.0f ? b0 * sign : 0.0f;
            b1 = b1 * sign > 0.0f ? b1 * sign : 0.0f;
            b2 = b2 * sign > 0.0f ? b2 * sign : 0.0f;
            const float sum = b0 + b1 + b2;
            const float scale = 1.0f / (sum > 0.0f ? sum : 1.0f);
            b0 = sum > 0.0f ? b0 * scale : 1.0f;
            b1 = b1 * scale;
            b2 = b2 * scale;
            const Vec3 position = blend(t.position, b0, b1, b2);
            const Vec3 normal = blend(t.normal, b0, b1, b2);
            out.barycentric.x[i] = b0;
            out.barycentric.y[i] = b1;
            out.barycentric.z[i] = b2;
            out.position.x[i] = position.x;
            out.position.y[i] = position.y;
            out.position.z[i] = position.z;
            out.vertex_normal.x[i] = normal.x;
            out.vertex_normal.y[i] = normal.y;
            out.vertex_normal.z[i] = normal.z;
        }
    }
};

using Indices = std::array<std::uint32_t, 3>;

Indices corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const std::size_t first = 3 * std::size_t{triangle};
    return {mesh.corners[first], mesh.corners[first + 1], mesh.corners[first + 2]};
}

Corners corners(const Vec3Arrays& arrays, const Indices& vertices) {
    const ConstVec3Span span = arrays.span();
    return {{span[vertices[0]], span[vertices[1]], span[vertices[2]]}};
}

/// uv and derivatives of points whose barycentric coordinates are known.
void blend_attributes(const Mesh& mesh, const Indices& vertices, PointNeeds needs, std::size_t first,
                      std::size_t count, SurfacePoints& points) {
    const ConstVec3Span weight = std::as_const(points.barycentric).span();
    if (needs.uv) {
        const bool has_uv = !mesh.u.empty();
        for (std::size_t i = first; i < first + count; ++i) {
            const auto mix = [&](const std::vector<float>& a) {
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
            // A mesh without parameters has those of its triangles: the edges from the first corner.
            const Corners p = corners(mesh.position, vertices);
            for (std::size_t k = 0; k < 3; ++k) {
                dpdu.at[k] = p.at[1] - p.at[0];
                dpdv.at[k] = p.at[2] - p.at[0];
            }
        } else {
            dpdu = corners(mesh.dpdu, vertices);
            dpdv = corners(mesh.dpdv, vertices);
        }
        for (std::size_t i = first; i < first + count; ++i) {
            points.dpdu.span().set(i, blend(dpdu, weight.x[i], weight.y[i], weight.z[i]));
            points.dpdv.span().set(i, blend(dpdv, weight.x[i], weight.y[i], weight.z[i]));
        }
    }
}

/// Point `i` of a batch: a place on a triangle.
void put_place(const Mesh& mesh, std::uint32_t triangle, Vec3 weight, PointNeeds needs, std::size_t i,
               SurfacePoints& points) {
    const Indices vertices = corners_of(mesh, triangle);
    const auto blended = [&](const Vec3Arrays& arrays) {
        return blend(corners(arrays, vertices), weight.x, weight.y, weight.z);
    };
    points.position.span().set(i, blended(mesh.position));
    points.face_normal.span().set(i, mesh.face_normal.span()[triangle]);
    points.vertex_normal.span().set(i, blended(mesh.vertex_normal));
    points.barycentric.span().set(i, weight);
    if (needs.uv || needs.derivatives) blend_attributes(mesh, vertices, needs, i, 1, points);
}

}  // namespace

SurfacePoints::SurfacePoints() {
    for (Vec3Arrays* const arrays : {&position, &face_normal, &vertex_normal, &barycentric, &dpdu, &dpdv}) {
        arrays->resize(k_batch_size);
    }
    for (std::vector<float>* const array : {&facing, &u, &v}) array->resize(k_batch_size);
}

bool ProjectedMesh::is_back(std::uint32_t triangle) const {
    if (mesh.closed) return false;
    const Indices vertices = corners_of(mesh, triangle);
    const bool perspective = scene.camera.projection == Projection::perspective;
    double x[3], y[3], w[3];
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = first_vertex + vertices[k];
        x[k] = scene.x[v];
        y[k] = scene.y[v];
        w[k] = perspective ? scene.distance[v] : 1.0f;
    }
    // Twice the signed area, y down: the front is counter-clockwise with y up.
    return x[0] * (y[1] * w[2] - y[2] * w[1]) - y[0] * (x[1] * w[2] - x[2] * w[1]) +
               w[0] * (x[1] * y[2] - x[2] * y[1]) >
           0;
}

void gather_fragments(const ProjectedMesh& source, const FragmentList& fragments, std::size_t first,
                      std::size_t count, PointNeeds needs, SurfacePoints& points) {
    const Mesh& mesh = source.mesh;
    const bool perspective = source.scene.camera.projection == Projection::perspective;
    points.count = count;
    for (std::size_t begin = 0; begin < count;) {
        const std::uint32_t triangle = fragments.triangle[first + begin];
        std::size_t end = begin + 1;
        while (end < count && fragments.triangle[first + end] == triangle) ++end;

        const Indices vertices = corners_of(mesh, triangle);
        TriangleAttributes t;
        for (std::size_t k = 0; k < 3; ++k) {
            const std::size_t v = source.first_vertex + vertices[k];
            t.x[k] = source.scene.x[v];
            t.y[k] = source.scene.y[v];
            t.w[k] = perspective ? source.scene.distance[v] : 1.0f;
        }
        keep_in_range(t);
        t.position = corners(mesh.position, vertices);
        t.normal = corners(mesh.vertex_normal, vertices);
        multiversion<RunLoop>(
            t, end - begin, &fragments.x[first + begin], &fragments.y[first + begin],
            PointSpans{points.barycentric.span().from(begin), points.position.span().from(begin),
                       points.vertex_normal.span().from(begin)});
        const Vec3 face_normal = mesh.face_normal.span()[triangle];
        const float facing = source.is_back(triangle) ? -1.0f : 1.0f;
        const auto run = end - begin;
        std::fill_n(&points.face_normal.x[begin], run, face_normal.x);
        std::fill_n(&points.face_normal.y[begin], run, face_normal.y);
        std::fill_n(&points.face_normal.z[begin], run, face_normal.z);
        std::fill_n(&points.facing[begin], run, facing);
        if (needs.uv || needs.derivatives)
            blend_attributes(mesh, vertices, needs, begin, end - begin, points);
        begin = end;
    }
}

void gather_faces(const ProjectedMesh& source, std::span<const std::uint32_t> triangles, PointNeeds needs,
                  SurfacePoints& points) {
    constexpr float k_third = 1.0f / 3.0f;
    points.count = triangles.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        put_place(source.mesh, triangles[i], {k_third, k_third, k_third}, needs, i, points);
        points.facing[i] = source.is_back(triangles[i]) ? -1.0f : 1.0f;
    }
}

void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles, ConstVec3Span barycentric,
                   PointNeeds needs, SurfacePoints& points) {
    points.count = triangles.size();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        put_place(mesh, triangles[i], barycentric[i], needs, i, points);
        points.facing[i] = 1;
    }
}

void gather_vertices(const ProjectedMesh& source, std::span<const VertexSide> vertices, PointNeeds needs,
                     SurfacePoints& points) {
    const Mesh& mesh = source.mesh;
    points.count = vertices.size();
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i].vertex;
        const Vec3 normal = mesh.vertex_normal.span()[v];
        points.position.span().set(i, mesh.position.span()[v]);
        points.face_normal.span().set(i, normal);
        points.vertex_normal.span().set(i, normal);
        points.barycentric.span().set(i, {1, 0, 0});
        points.facing[i] = vertices[i].is_back ? -1.0f : 1.0f;
        if (needs.uv) {
            points.u[i] = mesh.u.empty() ? 0 : mesh.u[v];
            points.v[i] = mesh.v.empty() ? 0 : mesh.v[v];
        }
        if (needs.derivatives) {
            points.dpdu.span().set(i, mesh.dpdu.empty() ? Vec3{} : mesh.dpdu.span()[v]);
            points.dpdv.span().set(i, mesh.dpdv.empty() ? Vec3{} : mesh.dpdv.span()[v]);
        }
    }
}

}  // namespace candela
