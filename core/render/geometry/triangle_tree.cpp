module;

#include "candela/multiversion.h"
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

/// Lets rays pass where they enter: where they come against the triangle's normal, or it has none.
void ignore_entries(const RTCFilterFunctionNArguments* hits) {
    const unsigned count = hits->N;
    RTCRayN* const ray = hits->ray;
    RTCHitN* const hit = hits->hit;
    int* const valid = hits->valid;
    CANDELA_VECTORIZE
    for (unsigned i = 0; i < count; ++i) {
        const float cosine = RTCRayN_dir_x(ray, count, i) * RTCHitN_Ng_x(hit, count, i) +
                             RTCRayN_dir_y(ray, count, i) * RTCHitN_Ng_y(hit, count, i) +
                             RTCRayN_dir_z(ray, count, i) * RTCHitN_Ng_z(hit, count, i);
        valid[i] = cosine > 0 ? valid[i] : 0;
    }
}

/// Where a ray meets two triangles at their common edge, Embree's answer depends on the packet's other rays.
/// This close to an edge, in barycentric coordinates, a ray is traced on its own.
constexpr float k_near_edge = 1e-4f;

/// Whether Embree can compute with it: numbers, of which the squares are numbers, too.
template <class Vector>
bool is_sound(const Vector& v) {
    return (v.array().abs() < 1e18f).all();
}

constexpr std::uint32_t k_none = ~0u;  // instead of a triangle

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
    /// From a little before, since a point on the surface may lie beyond it by its rounding.
    Vector3f start(const Vector3d& point, const Vector3d& towards) const {
        return (point - rounding * towards).cast<float>();
    }
    Vector3d from_middle(Vec3 point) const { return vector(point) - middle; }
    /// The triangles at which rays that are close to each other leave, or k_none.
    std::array<std::uint32_t, Embree::k_packet_size> triangles_ahead(std::size_t count,
                                                                     const ConstVec3Span& origin,
                                                                     const ConstVec3Span& direction) const;
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
        embree.commit(t.scene);
    }
    embree.release_geometry(geometry);
    if (embree.get_device_error(embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

void TriangleTree::find_exits(const ConstVec3Span& origin, const ConstVec3Span& direction,
                              std::span<std::optional<RayExit>> exits) const {
    std::ranges::fill(exits, std::nullopt);
    if (tree_ == nullptr) return;
    const Tree& t = *tree_;
    for (std::size_t first = 0; first < exits.size(); first += Embree::k_packet_size) {
        const std::size_t count = std::min(Embree::k_packet_size, exits.size() - first);
        const auto triangles = t.triangles_ahead(count, origin.from(first), direction.from(first));
        for (std::size_t i = 0; i < count; ++i) {
            if (triangles[i] == k_none) continue;
            const Vector3d point = t.from_middle(origin[first + i]), towards = vector(direction[first + i]);
            std::optional<RayExit>& exit = exits[first + i];
            exit = t.exit_through(triangles[i], point, towards);
            if (!exit ||
                std::min({exit->barycentric.x, exit->barycentric.y, exit->barycentric.z}) < k_near_edge)
                exit =
                    t.exit_through(t.triangles_ahead(1, origin.from(first + i), direction.from(first + i))[0],
                                   point, towards);
        }
    }
}

auto TriangleTree::Tree::triangles_ahead(std::size_t count, const ConstVec3Span& origin,
                                         const ConstVec3Span& direction) const
    -> std::array<std::uint32_t, Embree::k_packet_size> {
    alignas(64) std::array<int, Embree::k_packet_size> is_valid{};
    RTCRayHit16 rays{};
    for (std::size_t i = 0; i < count; ++i) {
        const Vector3d towards = vector(direction[i]);
        const Vector3f from = start(from_middle(origin[i]), towards);
        // A faulty plugin's rays would disturb the others, and end the process where Embree has assertions.
        if (!is_sound(from) || !is_sound(towards)) continue;
        is_valid[i] = -1;
        rays.ray.org_x[i] = from.x();
        rays.ray.org_y[i] = from.y();
        rays.ray.org_z[i] = from.z();
        rays.ray.dir_x[i] = direction.x[i];
        rays.ray.dir_y[i] = direction.y[i];
        rays.ray.dir_z[i] = direction.z[i];
        rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
        rays.ray.mask[i] = ~0u;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    embree.trace(scene, is_valid, rays);
    std::array<std::uint32_t, Embree::k_packet_size> triangles;
    triangles.fill(k_none);
    for (std::size_t i = 0; i < count; ++i) {
        if (is_valid[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID)
            triangles[i] = rays.hit.primID[i];
    }
    return triangles;
}

std::optional<RayExit> TriangleTree::Tree::exit_through(std::uint32_t triangle, const Vector3d& point,
                                                        const Vector3d& towards) const {
    if (triangle == k_none) return std::nullopt;
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
