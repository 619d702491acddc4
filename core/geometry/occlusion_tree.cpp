module;

#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"
#include "internal/embree_headers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <tuple>
#include <vector>

module candela.geometry;

import :embree;
import :light_filter;
import :shaft_culling;
import candela.api;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

constexpr std::size_t k_size = OcclusionTree::k_packet;
static_assert(k_size == Embree::k_packet_size);

/// Embree's tree takes at most this many bytes per triangle, while it is being built: 93 to 105 as measured,
/// of spheres, needles and triangles at random; then 58 to 70. One thread takes a second per million.
constexpr std::uint64_t k_bytes_per_triangle = 120;

/// A triangle of a solid object that blocked a ray. It is likely to block the rays next to it (compare the
/// shadow cache of Haines and Greenberg 1986, "The light buffer").
struct CachedBlocker {
    Vec3 corner, edge_u, edge_v;
    float least_square = 0;          // of the determinant: for a cosine that is not small
    float most_square_distance = 0;  // from farther away, it looks so small that rounding matters

    CachedBlocker(const Mesh& mesh, std::uint32_t triangle) {
        const std::uint32_t* const index = &mesh.indices[3 * std::size_t{triangle}];
        corner = mesh.vertices[index[0]].position;
        edge_u = mesh.vertices[index[1]].position - corner;
        edge_v = mesh.vertices[index[2]].position - corner;
        const Vec3 third = edge_v - edge_u;
        const float area = length(cross(edge_u, edge_v));
        const float longest = std::max({dot(edge_u, edge_u), dot(edge_v, edge_v), dot(third, third)});
        least_square = 0x1p-16f * area * area;
        most_square_distance = 0x1p+20f * area * area / longest;
    }
};

/// Takes the rays out of a packet that a triangle certainly blocks, away from its edges and from the rays'
/// ends. The intersection of Moeller and Trumbore (1997).
struct CachedBlockerLoop {
    CANDELA_BATCH_LOOP static void run(CachedBlocker triangle, const RTCRay16* rays, int* valid, int* blocked,
                                       int* any_left) {
        constexpr float k_edge = 0x1p-8f, k_end = 0x1p-10f;
        const vec3 a(triangle.corner.x, triangle.corner.y, triangle.corner.z);
        const vec3 u(triangle.edge_u.x, triangle.edge_u.y, triangle.edge_u.z);
        const vec3 v(triangle.edge_v.x, triangle.edge_v.y, triangle.edge_v.z);
        int left = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) {
            const vec3 from = vec3(rays->org_x[i], rays->org_y[i], rays->org_z[i]) - a;
            const vec3 d(rays->dir_x[i], rays->dir_y[i], rays->dir_z[i]);
            const vec3 p = kernel::cross(d, v), q = kernel::cross(from, u);
            const float det = kernel::dot(u, p);  // positive where the ray enters
            const float at_u = kernel::dot(from, p), at_v = kernel::dot(d, q), t = kernel::dot(v, q);
            const float edge = k_edge * det, square = kernel::dot(from, from);
            const bool is_inside = (at_u > edge) & (at_v > edge) & (at_u + at_v < det - edge);
            const float along = kernel::dot(d, d);
            const bool is_between = (t * t * along > k_end * k_end * square * det * det) & (t > 0) &
                                    (t < (1 - k_end) * rays->tfar[i] * det);
            const bool is_sound = (det > 0) & (det * det > triangle.least_square * along) &
                                  (square < triangle.most_square_distance);
            const int now = (is_inside & is_between & is_sound) ? valid[i] : 0;
            blocked[i] |= now;
            valid[i] ^= now;
            left |= valid[i];
        }
        *any_left = left;
    }
};

/// One over a packet's directions.
struct Inverse {
    alignas(64) std::array<float, k_size> x, y, z;
};

/// Sixteen rays for Embree.
struct PacketLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span origin, ConstVec3Span direction, const float* length,
                                       const std::uint32_t* flags, RTCRay16* rays, Inverse* inverse,
                                       int* valid, int* any) {
        std::uint32_t all = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) {
            rays->org_x[i] = origin.x[i];
            rays->org_y[i] = origin.y[i];
            rays->org_z[i] = origin.z[i];
            rays->dir_x[i] = direction.x[i];
            rays->dir_y[i] = direction.y[i];
            rays->dir_z[i] = direction.z[i];
            rays->tnear[i] = 0.0f;
            rays->tfar[i] = length[i];
            rays->time[i] = 0.0f;
            rays->mask[i] = ~0u;
            rays->flags[i] = 0;
            rays->id[i] = flags[i] | static_cast<std::uint32_t>(i);
            valid[i] = flags[i] != 0 ? -1 : 0;
            all |= flags[i];
            // Not of zero, so that no product with it is NaN.
            inverse->x[i] = 1 / (direction.x[i] == 0 ? 1e-30f : direction.x[i]);
            inverse->y[i] = 1 / (direction.y[i] == 0 ? 1e-30f : direction.y[i]);
            inverse->z[i] = 1 / (direction.z[i] == 0 ? 1e-30f : direction.z[i]);
        }
        *any = static_cast<int>(all);
    }
};

/// 0 for the rays that were blocked, 1 for the others. Embree marks them by a negative end.
struct VisibleLoop {
    CANDELA_BATCH_LOOP static void run(const RTCRay16* rays, const int* valid, const int* blocked,
                                       float* visible) {
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) {
            const bool is_blocked = (blocked[i] != 0) | ((valid[i] != 0) & (rays->tfar[i] < 0));
            visible[i] = is_blocked ? 0.0f : 1.0f;
        }
    }
};

/// An object's box, and whether its own rays cannot meet it: it is solid, and convex.
struct Bounds {
    Box box;
    std::uint32_t object = 0;
    bool is_convex = false;
};

/// Whether no vertex is above any triangle, except for rounding. Only for shapes that say so, and small
/// meshes: each vertex is compared with each triangle.
bool is_convex(const Mesh& mesh) {
    constexpr std::size_t k_small = 64;
    if (mesh.is_convex) return true;
    if (mesh.triangle_count() > k_small) return false;
    const float tolerance = 0x1p-21f * length(mesh.bounds.size());
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 normal = mesh.face_normal.span()[t], corner = mesh.vertices[mesh.indices[3 * t]].position;
        for (const MeshVertex& vertex : mesh.vertices) {
            if (dot(normal, vertex.position - corner) > tolerance) return false;
        }
    }
    return true;
}

/// Whether any ray of a packet, from the surface of `object`, meets a box.
struct BoxesLoop {
    CANDELA_BATCH_LOOP static void run(const RTCRay16* rays, const Inverse* inverse, const int* valid,
                                       const Bounds* bounds, std::size_t count, std::uint32_t object,
                                       int* any) {
        int found = 0;
        for (const Bounds* each = bounds; each != bounds + count && found == 0; ++each) {
            if (each->is_convex && each->object == object) continue;
            const Box box = each->box;
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t i = 0; i < k_size; ++i) {
                const float x = inverse->x[i], y = inverse->y[i], z = inverse->z[i];
                const float ax = (box.low.x - rays->org_x[i]) * x, bx = (box.high.x - rays->org_x[i]) * x;
                const float ay = (box.low.y - rays->org_y[i]) * y, by = (box.high.y - rays->org_y[i]) * y;
                const float az = (box.low.z - rays->org_z[i]) * z, bz = (box.high.z - rays->org_z[i]) * z;
                const float x0 = ax < bx ? ax : bx, x1 = ax < bx ? bx : ax;
                const float y0 = ay < by ? ay : by, y1 = ay < by ? by : ay;
                const float z0 = az < bz ? az : bz, z1 = az < bz ? bz : az;
                float begin = x0 > y0 ? x0 : y0, end = x1 < y1 ? x1 : y1;
                begin = begin > z0 ? begin : z0;
                end = end < z1 ? end : z1;
                begin = begin > 0 ? begin : 0;
                end = end < rays->tfar[i] ? end : rays->tfar[i];
                found |= begin <= end ? valid[i] : 0;
            }
        }
        *any = found;
    }
};

/// The longest edge of the mesh's triangles, along any axis.
float largest_triangle(const Mesh& mesh) {
    float largest = 0;
    for (std::size_t i = 0; i < mesh.indices.size(); i += 3) {
        const Vec3 a = mesh.vertices[mesh.indices[i]].position;
        for (std::size_t k = 1; k < 3; ++k) {
            const Vec3 edge = mesh.vertices[mesh.indices[i + k]].position - a;
            largest = std::max({largest, std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
        }
    }
    return largest;
}

}  // namespace

struct OcclusionTree::Tree {
    const Embree& embree = Embree::instance();
    RTCScene scene = embree.new_scene(embree.device);
    std::vector<Surface> surfaces;
    std::vector<Bounds> bounds;              // of the objects that cast shadows
    std::vector<TriangleClusters> clusters;  // of these objects
    Box box{};                               // around them
    float largest = 0;                       // extent of a triangle that blocks light on both sides
    bool has_transparent = false;
    bool has_see_through = false;
    bool is_dense = false;

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { embree.release_scene(scene); }

    void add(const Mesh& mesh, Surface& surface) const;
    bool may_block(const Shaft& shaft, std::uint32_t object) const;

    /// Whether rays that start on `object` come near any object that may block them.
    bool meets_any(const RTCRay16& rays, const Inverse& inverse, const std::array<int, k_size>& valid,
                   std::uint32_t object) const;

    /// Whether a ray is blocked if it is traced on its own. Adds its hits of surfaces that let light pass.
    bool is_blocked(const ShadowRays& rays, std::size_t ray, std::vector<TransparentHit>& hits,
                    std::vector<PartialHit>* partial_hits) const;
};

void OcclusionTree::Tree::add(const Mesh& mesh, Surface& surface) const {
    auto* const geometry = embree.new_geometry(embree.device, RTC_GEOMETRY_TYPE_TRIANGLE);
    // Sixteen bytes are read of each vertex, which has as many.
    embree.set_shared_geometry_buffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                      mesh.vertices.data(), 0, sizeof(MeshVertex), mesh.vertices.size());
    embree.set_shared_geometry_buffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3,
                                      mesh.indices.data(), 0, 3 * sizeof(std::uint32_t),
                                      mesh.triangle_count());
    embree.set_geometry_user_data(geometry, &surface);
    embree.commit_geometry(geometry);
    embree.attach_geometry_by_id(scene, geometry, surface.object);
    embree.release_geometry(geometry);
}

bool OcclusionTree::Tree::may_block(const Shaft& shaft, std::uint32_t object) const {
    // With more, it would take longer than tracing a batch of rays.
    constexpr std::size_t k_most = 256;
    if (bounds.size() > k_most) return true;
    for (std::size_t i = 0; i < bounds.size(); ++i) {
        if (bounds[i].is_convex && bounds[i].object == object) continue;
        if (clusters[i].may_block(shaft)) return true;
    }
    return false;
}

OcclusionTree::OcclusionTree(std::span<const Occluder> occluders) : tree_(std::make_unique<Tree>()) {
    Tree& t = *tree_;
    std::uint64_t triangles = 0;
    for (const Occluder& each : occluders) {
        if (each.mesh != nullptr) triangles += each.mesh->triangle_count();
    }
    require_memory(triangles * k_bytes_per_triangle, "the tree of the triangles that cast shadows");
    constexpr std::uint64_t k_many = 4096;
    t.is_dense = triangles > k_many;
    t.surfaces.resize(occluders.size());
    for (std::size_t i = 0; i < occluders.size(); ++i) {
        const Occluder& occluder = occluders[i];
        if (occluder.mesh == nullptr || occluder.mesh->indices.empty()) continue;
        t.surfaces[i] = {.mesh = occluder.mesh,
                         .object = static_cast<std::uint32_t>(i),
                         .is_solid = occluder.is_solid,
                         .is_transparent = occluder.is_transparent,
                         .is_see_through = occluder.is_see_through,
                         .has_inside = occluder.mesh->open_edges == 0};
        t.has_transparent = t.has_transparent || occluder.is_transparent;
        t.has_see_through = t.has_see_through || occluder.is_see_through;
        if (!occluder.is_solid) t.largest = std::max(t.largest, largest_triangle(*occluder.mesh));
        t.add(*occluder.mesh, t.surfaces[i]);
        const Box box = enlarged(occluder.mesh->bounds);
        t.box = t.bounds.empty() ? box : united(t.box, box);
        t.bounds.push_back({box, t.surfaces[i].object, occluder.is_solid && is_convex(*occluder.mesh)});
        t.clusters.emplace_back(*occluder.mesh,
                                occluder.is_solid && !occluder.is_transparent && !occluder.is_see_through);
    }
    // Robust, so that no ray slips between triangles, and results do not depend on the shape of the tree.
    constexpr unsigned k_flags = unsigned{RTC_SCENE_FLAG_ROBUST} | unsigned{Embree::k_filters_by_call};
    // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): they are bits
    t.embree.set_scene_flags(t.scene, static_cast<RTCSceneFlags>(k_flags));
    t.embree.commit(t.scene, true);
    if (t.embree.get_device_error(t.embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

Box OcclusionTree::starting(const Box& points) const noexcept {
    const float margin = 8 * least_margin();  // above the surface, towards the light, and inward
    const Box wide = enlarged(points);
    return {wide.low - Vec3{margin, margin, margin}, wide.high + Vec3{margin, margin, margin}};
}

bool OcclusionTree::may_block(const Box& points, const Box& light, std::uint32_t object) const noexcept {
    return tree_->may_block(shaft_to(starting(points), light), object);
}

bool OcclusionTree::may_block(const Box& points, Vec3 towards, std::uint32_t object) const noexcept {
    return tree_->may_block(shaft_towards(starting(points), towards, tree_->box), object);
}

OcclusionTree::OcclusionTree(OcclusionTree&&) noexcept = default;
OcclusionTree& OcclusionTree::operator=(OcclusionTree&&) noexcept = default;
OcclusionTree::~OcclusionTree() = default;

float OcclusionTree::least_margin() const noexcept { return k_relative_margin * tree_->largest; }
bool OcclusionTree::is_solid(std::uint32_t object) const noexcept { return tree_->surfaces[object].is_solid; }
bool OcclusionTree::is_dense() const noexcept { return tree_->is_dense; }
bool OcclusionTree::has_transparent() const noexcept { return tree_->has_transparent; }
bool OcclusionTree::has_see_through() const noexcept { return tree_->has_see_through; }

namespace {

/// Sets the first ray of an empty packet.
void set_ray(const ShadowRays& rays, std::size_t ray, RTCRay16& packet) {
    const Vec3 origin = rays.origin[ray], direction = rays.direction[ray];
    packet.org_x[0] = origin.x;
    packet.org_y[0] = origin.y;
    packet.org_z[0] = origin.z;
    packet.dir_x[0] = direction.x;
    packet.dir_y[0] = direction.y;
    packet.dir_z[0] = direction.z;
    packet.tfar[0] = rays.length[ray];
    packet.mask[0] = ~0u;
    packet.id[0] = rays.flags[ray] | static_cast<std::uint32_t>(ray % k_size);
}

/// The mask of a packet whose first ray alone is active.
alignas(64) constexpr std::array<int, k_size> k_one_ray{-1};

}  // namespace

bool OcclusionTree::Tree::is_blocked(const ShadowRays& rays, std::size_t ray,
                                     std::vector<TransparentHit>& hits,
                                     std::vector<PartialHit>* partial_hits) const {
    PacketContext context;
    context.object = rays.object;
    context.is_one_ray = true;
    context.hits = &hits;
    context.partial_hits = partial_hits;
    RTCRay16 traced{};
    set_ray(rays, ray, traced);
    embree.occluded(scene, k_one_ray, let_pass, context.context, traced);
    return traced.tfar[0] < 0;
}

bool OcclusionTree::Tree::meets_any(const RTCRay16& rays, const Inverse& inverse,
                                    const std::array<int, k_size>& valid, std::uint32_t object) const {
    // A packet takes Embree as long as some sixteen boxes.
    constexpr std::size_t k_few = 16;
    if (bounds.size() > k_few) return true;
    int any = 0;
    int* const to = &any;
    multiversion<BoxesLoop>(&rays, &inverse, valid.data(), bounds.data(), bounds.size(), object, to);
    return any != 0;
}

void OcclusionTree::find_visible(const ShadowRays& rays, float* visible, std::vector<Crossing>& crossings,
                                 std::vector<Passage>* passages) const {
    const Tree& t = *tree_;
    std::vector<TransparentHit> hits;
    std::vector<PartialHit> partial_hits;
    PacketContext packet;
    packet.object = rays.object;
    packet.hits = &hits;
    packet.partial_hits = passages != nullptr ? &partial_hits : nullptr;
    std::optional<CachedBlocker> cached;
    for (std::size_t first = 0; first < rays.count; first += k_size) {
        const std::uint32_t* const flags = rays.flags + first;
        float* const to = visible + first;
        alignas(64) std::array<int, k_size> valid, blocked{};
        RTCRay16 traced;
        Inverse inverse;
        Inverse* const to_inverse = &inverse;
        int any_left = 0;
        int* const to_left = &any_left;
        multiversion<PacketLoop>(rays.origin.from(first), rays.direction.from(first), rays.length + first,
                                 flags, &traced, to_inverse, valid.data(), to_left);
        if (any_left != 0 && cached)
            multiversion<CachedBlockerLoop>(*cached, &traced, valid.data(), blocked.data(), to_left);
        const bool is_traced = any_left != 0 && t.meets_any(traced, inverse, valid, rays.object);
        packet.near_edges = 0;
        packet.blocker = nullptr;
        if (is_traced) t.embree.occluded(t.scene, valid, let_pass, packet.context, traced);
        multiversion<VisibleLoop>(&traced, valid.data(), blocked.data(), to);
        if (!is_traced) continue;
        if (packet.blocker != nullptr) cached.emplace(*packet.blocker->mesh, packet.blocker_triangle);
        if (packet.near_edges != 0) {
            const auto is_repeated = [&](std::uint32_t ray) { return (packet.near_edges >> ray & 1) != 0; };
            std::erase_if(hits, [&](const TransparentHit& hit) { return is_repeated(hit.ray); });
            std::erase_if(partial_hits, [&](const PartialHit& hit) { return is_repeated(hit.passage.ray); });
            for (std::size_t i = 0; i < k_size; ++i) {
                if (is_repeated(static_cast<std::uint32_t>(i)) && to[i] != 0 &&
                    t.is_blocked(rays, first + i, hits, packet.partial_hits))
                    to[i] = 0;
            }
        }
        if (!partial_hits.empty()) {
            std::erase_if(partial_hits, [&](const PartialHit& hit) { return to[hit.passage.ray] == 0; });
            add_passages(partial_hits, static_cast<std::uint32_t>(first), *passages);
        }
        if (hits.empty()) continue;
        std::erase_if(hits, [&](const TransparentHit& hit) { return to[hit.ray] == 0; });
        add_crossings(hits, static_cast<std::uint32_t>(first), rays.length + first, crossings);
    }
}

std::optional<Blocker> OcclusionTree::find_blocker(const ShadowRays& rays, std::size_t ray) const {
    const Tree& t = *tree_;
    std::vector<TransparentHit> hits;
    PacketContext context;
    context.object = rays.object;
    context.is_one_ray = true;
    context.hits = &hits;
    RTCRayHit16 traced{};
    set_ray(rays, ray, traced.ray);
    traced.hit.geomID[0] = RTC_INVALID_GEOMETRY_ID;
    t.embree.trace(t.scene, k_one_ray, let_pass, context.context, traced);
    if (traced.hit.geomID[0] == RTC_INVALID_GEOMETRY_ID) return std::nullopt;
    return Blocker{traced.hit.geomID[0], traced.hit.primID[0], traced.ray.tfar[0]};
}

}  // namespace candela
