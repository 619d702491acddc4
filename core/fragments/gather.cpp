// Attributes of faces, vertices and fragments.
module;

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

using Indices = std::array<std::uint32_t, 3>;

Indices corners_of(const Mesh& mesh, std::uint32_t triangle) {
    const std::size_t first = 3 * std::size_t{triangle};
    return {mesh.corners[first], mesh.corners[first + 1], mesh.corners[first + 2]};
}

using Corners = std::array<Vec3, 3>;

Corners corners(const Vec3Arrays& arrays, const Indices& vertices) {
    const ConstVec3Span span = arrays.span();
    return {span[vertices[0]], span[vertices[1]], span[vertices[2]]};
}

Vec3 blend(const Corners& c, const Vec3& weight) {
    return weight.x * c[0] + weight.y * c[1] + weight.z * c[2];
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
                dpdu[k] = p[1] - p[0];
                dpdv[k] = p[2] - p[0];
            }
        } else {
            dpdu = corners(mesh.dpdu, vertices);
            dpdv = corners(mesh.dpdv, vertices);
        }
        for (std::size_t i = first; i < first + count; ++i) {
            points.dpdu.span().set(i, blend(dpdu, weight[i]));
            points.dpdv.span().set(i, blend(dpdv, weight[i]));
        }
    }
}

/// Point `i` of a batch: a place on a triangle.
void put_place(const Mesh& mesh, std::uint32_t triangle, Vec3 weight, PointNeeds needs, std::size_t i,
               SurfacePoints& points) {
    const Indices vertices = corners_of(mesh, triangle);
    const auto blended = [&](const Vec3Arrays& arrays) { return blend(corners(arrays, vertices), weight); };
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
    for (AlignedVector<float>* const array : {&facing, &u, &v}) array->resize(k_batch_size);
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

namespace {

TriangleAttributes attributes_of(const ProjectedMesh& source, const Indices& vertices) {
    const bool perspective = source.scene.camera.projection == Projection::perspective;
    const ConstVec3Span position = source.mesh.position.span(), normal = source.mesh.vertex_normal.span();
    TriangleAttributes t;
    for (std::size_t k = 0; k < 3; ++k) {
        const std::size_t v = source.first_vertex + vertices[k];
        t.x[k] = source.scene.x[v];
        t.y[k] = source.scene.y[v];
        t.w[k] = perspective ? source.scene.distance[v] : 1.0f;
        t.position[k] = position[vertices[k]];
        t.normal[k] = normal[vertices[k]];
    }
    if (!source.scene.is_moderate) keep_in_range(t);
    return t;
}

/// The fragments of one triangle that are side by side in a batch.
struct Group {
    std::uint32_t triangle;
    std::size_t first, count;
};

/// Lays the places of a batch's fragments side by side, and calls `visit` for each triangle's.
template <class Visit>
void each_group(std::span<const FragmentRun> runs, std::array<float, k_batch_size>& x,
                std::array<float, k_batch_size>& y, Visit visit) {
    std::size_t end = 0;
    Group group{runs.empty() ? 0 : runs.front().triangle, 0, 0};
    for (const FragmentRun& run : runs) {
        if (run.triangle != group.triangle) {
            visit(group);
            group = {run.triangle, end, 0};
        }
        for (std::uint32_t i = 0; i < run.count; ++i) {
            x[end + i] = run.x + static_cast<float>(i);
            y[end + i] = run.y;
        }
        end += run.count;
        group.count += run.count;
    }
    if (group.count > 0) visit(group);
}

/// From this many fragments on, a triangle is worth a loop of its own.
constexpr std::size_t k_worth_a_loop = 6;

}  // namespace

void gather_fragments(const ProjectedMesh& source, std::span<const FragmentRun> runs, PointNeeds needs,
                      SurfacePoints& points) {
    alignas(64) std::array<float, k_batch_size> x, y;
    const auto spans_from = [&](std::size_t first) -> InterpolatedSpans {
        return {points.barycentric.span().from(first), points.position.span().from(first),
                points.vertex_normal.span().from(first)};
    };
    TriangleLanes lanes;
    std::size_t first_lane = 0;
    const auto finish_lanes = [&] {
        if (lanes.size() > 0) lanes.interpolate(&x[first_lane], &y[first_lane], spans_from(first_lane));
    };
    points.any_from_behind = false;
    points.count = 0;
    each_group(runs, x, y, [&](const Group& group) {
        const Indices vertices = corners_of(source.mesh, group.triangle);
        const TriangleAttributes triangle = attributes_of(source, vertices);
        if (group.count >= k_worth_a_loop) {
            finish_lanes();
            interpolate(triangle, group.count, &x[group.first], &y[group.first], spans_from(group.first));
        } else {
            for (std::size_t i = group.first; i < group.first + group.count; ++i) {
                if (lanes.is_full()) finish_lanes();
                if (lanes.size() == 0) first_lane = i;
                lanes.add(triangle);
            }
        }
        const Vec3 face_normal = source.mesh.face_normal.span()[group.triangle];
        const bool is_back = source.is_back(group.triangle);
        points.any_from_behind = points.any_from_behind || is_back;
        std::fill_n(&points.face_normal.x[group.first], group.count, face_normal.x);
        std::fill_n(&points.face_normal.y[group.first], group.count, face_normal.y);
        std::fill_n(&points.face_normal.z[group.first], group.count, face_normal.z);
        std::fill_n(&points.facing[group.first], group.count, is_back ? -1.0f : 1.0f);
        points.count += group.count;
    });
    finish_lanes();
    if (!needs.uv && !needs.derivatives) return;
    each_group(runs, x, y, [&](const Group& group) {
        blend_attributes(source.mesh, corners_of(source.mesh, group.triangle), needs, group.first,
                         group.count, points);
    });
}

void gather_faces(const ProjectedMesh& source, std::span<const std::uint32_t> triangles, PointNeeds needs,
                  SurfacePoints& points) {
    constexpr float k_third = 1.0f / 3.0f;
    points.count = triangles.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        put_place(source.mesh, triangles[i], {k_third, k_third, k_third}, needs, i, points);
        const bool is_back = source.is_back(triangles[i]);
        points.facing[i] = is_back ? -1.0f : 1.0f;
        points.any_from_behind = points.any_from_behind || is_back;
    }
}

void gather_places(const Mesh& mesh, std::span<const std::uint32_t> triangles, ConstVec3Span barycentric,
                   PointNeeds needs, SurfacePoints& points) {
    points.count = triangles.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        put_place(mesh, triangles[i], barycentric[i], needs, i, points);
        points.facing[i] = 1;
    }
}

void gather_vertices(const ProjectedMesh& source, std::span<const VertexSide> vertices, PointNeeds needs,
                     SurfacePoints& points) {
    const Mesh& mesh = source.mesh;
    points.count = vertices.size();
    points.any_from_behind = false;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const std::uint32_t v = vertices[i].vertex;
        const Vec3 normal = mesh.vertex_normal.span()[v];
        points.position.span().set(i, mesh.position.span()[v]);
        points.face_normal.span().set(i, normal);
        points.vertex_normal.span().set(i, normal);
        points.barycentric.span().set(i, {1, 0, 0});
        points.facing[i] = vertices[i].is_back ? -1.0f : 1.0f;
        points.any_from_behind = points.any_from_behind || vertices[i].is_back;
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
