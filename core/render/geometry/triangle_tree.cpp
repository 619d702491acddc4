module;

#include "internal/embree_headers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>

module candela.geometry;

import :embree;

namespace candela {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

Vector3d vector(Vec3 v) { return {double{v.x}, double{v.y}, double{v.z}}; }

double triple_product(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return a.dot(b.cross(c)); }

/// Lets a ray pass where it enters: where it comes against the triangle's normal, or the triangle has none.
void ignore_entries(const RTCFilterFunctionNArguments* hits) {
    RTCRayN* const ray = hits->ray;
    RTCHitN* const hit = hits->hit;
    const float cosine = RTCRayN_dir_x(ray, 1, 0) * RTCHitN_Ng_x(hit, 1, 0) +
                         RTCRayN_dir_y(ray, 1, 0) * RTCHitN_Ng_y(hit, 1, 0) +
                         RTCRayN_dir_z(ray, 1, 0) * RTCHitN_Ng_z(hit, 1, 0);
    if (!(cosine > 0)) hits->valid[0] = 0;
}

}  // namespace

/// Embree's tree of the triangles, moved to the origin, where floats are finest.
struct TriangleTree::Tree {
    const Embree& embree = Embree::instance();
    RTCScene scene = embree.new_scene(embree.device);
    std::span<const float> position;         // x y z of each vertex; Embree's own array
    std::span<const std::uint32_t> indices;  // likewise
    Vector3d middle = Vector3d::Zero();
    double rounding = 0;  // of a point on the surface, in float

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { embree.release_scene(scene); }

    Vector3d vertex(std::size_t i) const {
        return {double{position[3 * i]}, double{position[3 * i + 1]}, double{position[3 * i + 2]}};
    }
    /// In double, from a point relative to the middle.
    std::optional<RayExit> exit_through(std::uint32_t triangle, const Vector3d& point,
                                        const Vector3d& towards) const;
};

TriangleTree::TriangleTree(ConstVec3Span position, std::size_t vertex_count,
                           std::span<const std::uint32_t> indices) {
    if (indices.empty()) return;
    tree_ = std::make_unique<Tree>();
    Tree& t = *tree_;
    const Embree& embree = t.embree;
    Eigen::AlignedBox3d box;
    for (const std::uint32_t i : indices) box.extend(Vector3d(position.x[i], position.y[i], position.z[i]));
    t.middle = box.center();
    t.rounding = 1e-6 * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());

    auto* const geometry = embree.new_geometry(embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const vertices = static_cast<float*>(embree.set_new_geometry_buffer(
        geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 3 * sizeof(float), vertex_count));
    auto* const corners = static_cast<std::uint32_t*>(embree.set_new_geometry_buffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), indices.size() / 3));
    if (vertices != nullptr && corners != nullptr) {
        for (std::size_t i = 0; i < vertex_count; ++i) {
            const Vector3f p =
                (Vector3d(position.x[i], position.y[i], position.z[i]) - t.middle).cast<float>();
            std::copy_n(p.data(), 3, vertices + 3 * i);
        }
        std::ranges::copy(indices, corners);
        t.position = {vertices, 3 * vertex_count};
        t.indices = {corners, indices.size()};
        embree.set_geometry_intersect_filter_function(geometry, ignore_entries);
        embree.commit_geometry(geometry);
        embree.attach_geometry(t.scene, geometry);
        embree.set_scene_flags(t.scene, RTC_SCENE_FLAG_ROBUST);  // nothing slips between triangles
        embree.commit_scene(t.scene);
    }
    embree.release_geometry(geometry);
    if (embree.get_device_error(embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

std::optional<RayExit> TriangleTree::exit_of(Vec3 origin, Vec3 direction) const {
    if (tree_ == nullptr) return std::nullopt;
    const Tree& t = *tree_;
    const Vector3d point = vector(origin) - t.middle, towards = vector(direction);
    // From a little before, since a point on the surface may lie beyond it by its rounding.
    const Vector3f from = (point - t.rounding * towards).cast<float>();
    RTCRayHit ray;
    ray.ray = {.org_x = from.x(),
               .org_y = from.y(),
               .org_z = from.z(),
               .tnear = 0,
               .dir_x = direction.x,
               .dir_y = direction.y,
               .dir_z = direction.z,
               .time = 0,
               .tfar = std::numeric_limits<float>::infinity(),
               .mask = ~0u,
               .id = 0,
               .flags = 0};
    ray.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    t.embree.intersect1(t.scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    t.embree.intersect1(t.scene, &context, &ray);
#endif
    if (ray.hit.geomID == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return t.exit_through(ray.hit.primID, point, towards);
}

std::optional<RayExit> TriangleTree::Tree::exit_through(std::uint32_t triangle, const Vector3d& point,
                                                        const Vector3d& towards) const {
    const std::uint32_t* const corner = &indices[3 * std::size_t{triangle}];
    const Vector3d a = vertex(corner[0]) - point, b = vertex(corner[1]) - point,
                   c = vertex(corner[2]) - point;
    // The volumes spanned by the ray and the edges; none is negative, even where rounding put the hit beside
    // the triangle.
    const double u = std::max(triple_product(towards, b, c), 0.0),
                 v = std::max(triple_product(towards, c, a), 0.0),
                 w = std::max(triple_product(towards, a, b), 0.0), sum = u + v + w;
    if (!(sum > 0)) return std::nullopt;
    return RayExit{triangle,
                   static_cast<float>(std::max(triple_product(a, b, c) / sum, 0.0)),
                   {static_cast<float>(u / sum), static_cast<float>(v / sum), static_cast<float>(w / sum)}};
}

}  // namespace candela
