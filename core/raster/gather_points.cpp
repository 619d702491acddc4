// Given points, as opposed to the fragments of triangles.
module;

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>

module candela.raster;

import :attributes;

namespace candela {

namespace {

// For points that do not belong to a pixel.

void clear_pixels(SurfacePoints& points) {
    std::ranges::fill(points.pixel_x, 0u);
    std::ranges::fill(points.pixel_y, 0u);
    std::ranges::fill(points.coverage, 0.0f);
}

void clear_footprint(SurfacePoints& points) {
    for (AlignedVector<float>* const array : {&points.dudx, &points.dvdx, &points.dudy, &points.dvdy})
        std::ranges::fill(*array, 0.0f);
    for (AlignedVector<float>& array : points.second_footprint) std::ranges::fill(array, 0.0f);
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
    if (needs.channels) std::ranges::for_each(points.channels, fill);
    if (needs.footprint) clear_footprint(points);
    if (needs.pixel) clear_pixels(points);
    if (needs.derivatives) {
        fill_all(points.dpdu);
        fill_all(points.dpdv);
    }
    if (needs.triangle) {
        for (Vec3Arrays& arrays : points.corner_position) fill_all(arrays);
        for (Vec3Arrays& arrays : points.corner_normal) fill_all(arrays);
    }
}

}  // namespace

void gather_faces(const ProjectedMesh& source, std::span<const std::uint32_t> triangles, PointNeeds needs,
                  SurfacePoints& points) {
    constexpr float k_third = 1.0f / 3.0f;
    points.has_color = needs.color = needs.color && !source.mesh.color.empty();
    take_channels(source.mesh, needs, points);
    points.count = triangles.size();
    face_forward(points);
    set_triangles(needs, triangles, points);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        evaluate_point(source.mesh, triangles[i], {k_third, k_third, k_third}, needs, i, points);
        const bool is_back = source.is_back(triangles[i]);
        if (is_back) points.facing[i] = -1;
        points.any_from_behind = points.any_from_behind || is_back;
    }
    fill_up(needs, points);
}

void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles, ConstVec3Span barycentric,
                   PointNeeds needs, SurfacePoints& points) {
    points.has_color = needs.color = needs.color && !mesh.color.empty();
    take_channels(mesh, needs, points);
    points.count = points.filled = triangles.size();
    face_forward(points);
    set_triangles(needs, triangles, points);
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        evaluate_point(mesh, triangles[i], barycentric[i], needs, i, points);
    }
}

void gather_vertices(const ProjectedMesh& source, std::span<const VertexSide> vertices, PointNeeds needs,
                     SurfacePoints& points) {
    const Mesh& mesh = source.mesh;
    needs.triangle = false;
    points.has_color = needs.color = needs.color && !mesh.color.empty();
    take_channels(mesh, needs, points);
    points.count = vertices.size();
    points.has_triangle = false;
    face_forward(points);
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i].vertex;
        const Vec3 normal = mesh.vertices[v].normal;
        points.position.span().set(i, mesh.position.span()[v]);
        points.face_normal.span().set(i, normal);
        points.vertex_normal.span().set(i, normal);
        points.barycentric.span().set(i, {1, 0, 0});
        if (vertices[i].is_back) points.facing[i] = -1;
        points.any_from_behind = points.any_from_behind || vertices[i].is_back;
        if (needs.color) points.color.span().set(i, mesh.color.span()[v]);
        if (needs.uv) {
            points.u[i] = mesh.u.empty() ? 0 : mesh.u[v];
            points.v[i] = mesh.v.empty() ? 0 : mesh.v[v];
        }
        for (std::size_t c = 0; needs.channels && c < mesh.channels.size(); ++c)
            points.channels[c][i] = mesh.channels[c][v];
        if (needs.derivatives) {
            points.dpdu.span().set(i, mesh.dpdu.empty() ? Vec3{} : mesh.dpdu.span()[v]);
            points.dpdv.span().set(i, mesh.dpdv.empty() ? Vec3{} : mesh.dpdv.span()[v]);
        }
    }
    fill_up(needs, points);
}

}  // namespace candela
