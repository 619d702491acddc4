module;

#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>

module candela.raster;

import :attributes;

namespace candela {

namespace {

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

/// Repeats the vertices of a triangle for each of its points.
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

struct BlendLoop {
    CANDELA_BATCH_LOOP static void run(Vec3 a, Vec3 b, ConstVec3Span weight, std::size_t count, float* to_a,
                                       float* to_b) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            to_a[i] = weight.x[i] * a.x + weight.y[i] * a.y + weight.z[i] * a.z;
            to_b[i] = weight.x[i] * b.x + weight.y[i] * b.y + weight.z[i] * b.z;
        }
    }
};

}  // namespace

void blend_attributes(const Mesh& mesh, const Indices& vertices, PointNeeds needs, std::size_t first,
                      std::size_t count, SurfacePoints& points) {
    const ConstVec3Span weight = std::as_const(points.barycentric).span();
    if (needs.color) {
        const Corners color = indices(mesh.color, vertices);
        for (std::size_t i = first; i < first + count; ++i)
            points.color.span().set(i, blend(color, weight[i]));
    }
    if (needs.uv && mesh.u.empty()) {
        std::fill_n(&points.u[first], count, 0.0f);
        std::fill_n(&points.v[first], count, 0.0f);
    } else if (needs.uv) {
        const auto at_corners = [&](const AlignedVector<float>& a) {
            return Vec3{a[vertices[0]], a[vertices[1]], a[vertices[2]]};
        };
        multiversion<BlendLoop>(at_corners(mesh.u), at_corners(mesh.v), weight.from(first), count,
                                &points.u[first], &points.v[first]);
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

void take_channels(const Mesh& mesh, PointNeeds& needs, SurfacePoints& points) {
    needs.channels = needs.channels && !mesh.channels.empty();
    while (needs.channels && points.channels.size() < mesh.channels.size())
        points.channels.emplace_back(k_batch_size + k_lanes);
}

void blend_channels(const Mesh& mesh, const Indices& vertices, std::size_t channel, std::size_t first,
                    std::size_t count, SurfacePoints& points) {
    const ConstVec3Span weight = std::as_const(points.barycentric).span();
    for (std::size_t c = channel; c < mesh.channels.size(); ++c) {
        const AlignedVector<float>& of = mesh.channels[c];
        const Vec3 corners{of[vertices[0]], of[vertices[1]], of[vertices[2]]};
        for (std::size_t i = first; i < first + count; ++i)
            points.channels[c][i] =
                weight.x[i] * corners.x + weight.y[i] * corners.y + weight.z[i] * corners.z;
    }
}

void evaluate_point(const Mesh& mesh, std::uint32_t triangle, Vec3 weight, PointNeeds needs, std::size_t i,
                    SurfacePoints& points) {
    const Indices vertices = corners_of(mesh, triangle);
    const MeshVertex &a = mesh.vertices[vertices[0]], &b = mesh.vertices[vertices[1]],
                     &c = mesh.vertices[vertices[2]];
    points.position.span().set(i, blend({a.position, b.position, c.position}, weight));
    points.face_normal.span().set(i, mesh.face_normal.span()[triangle]);
    points.vertex_normal.span().set(i, mesh.is_faceted ? mesh.face_normal.span()[triangle]
                                                       : blend({a.normal, b.normal, c.normal}, weight));
    points.barycentric.span().set(i, weight);
    if (needs.more()) blend_attributes(mesh, vertices, needs, i, 1, points);
    if (needs.channels) blend_channels(mesh, vertices, 0, i, 1, points);
}

void set_triangles(PointNeeds needs, std::span<const std::uint32_t> triangles, SurfacePoints& points) {
    points.has_triangle = needs.triangle_index;
    if (needs.triangle_index) std::ranges::copy(triangles, points.triangle.begin());
}

void face_forward(SurfacePoints& points) {
    if (points.any_from_behind) std::ranges::fill(points.facing, 1.0f);
    points.any_from_behind = false;
}

SurfacePoints::SurfacePoints() {
    // The whole vectors of a batch's last triangle may begin anywhere.
    for (Vec3Arrays* const arrays :
         {&position, &face_normal, &vertex_normal, &barycentric, &dpdu, &dpdv, &color}) {
        arrays->resize(k_batch_size + k_lanes);
    }
    for (AlignedVector<float>* const array : {&facing, &u, &v, &dudx, &dvdx, &dudy, &dvdy})
        array->resize(k_batch_size + k_lanes);
    for (AlignedVector<float>& array : second_footprint) array.resize(k_batch_size + k_lanes);
    for (AlignedVector<std::uint32_t>* const array : {&pixel_x, &pixel_y, &triangle})
        array->resize(k_batch_size + k_lanes);
    coverage.resize(k_batch_size + k_lanes);
    std::ranges::fill(facing, 1.0f);
}

}  // namespace candela
