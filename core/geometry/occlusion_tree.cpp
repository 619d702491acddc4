module;

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
import candela.api;
import candela.util;

namespace candela {

namespace {

constexpr std::size_t k_size = OcclusionTree::k_packet;
static_assert(k_size == Embree::k_packet_size);

/// Embree's tree takes at most this many bytes per triangle, while it is being built: 93 to 105 as measured,
/// of spheres, needles and triangles at random; then 58 to 70. One thread takes a second per million.
constexpr std::uint64_t k_bytes_per_triangle = 120;

/// Where several triangles meet, Embree's answer depends on the packet's other rays. This close to an edge,
/// in barycentric coordinates, a ray is traced on its own.
constexpr float k_near_edge = 0x1p-12f;

/// Hits of a closed object in one sense are the same crossing, of an edge, if they are this close to each
/// other, relative to their distance.
constexpr float k_same_edge = 0x1p-10f;

/// Embree passes it to the filter with each hit of the surface.
struct Surface {
    std::uint32_t object = 0;
    bool is_solid = false;
    bool is_transparent = false;
    bool has_inside = false;
};

/// A hit of a transparent object: rays meet its surface in pairs.
struct TransparentHit {
    std::uint32_t ray, object;
    float along;  // the ray, in multiples of its direction
    bool enters, is_near_edge;
    std::uint32_t triangle;
};

/// The filter's knowledge of a packet. Its beginning is Embree's own.
struct PacketContext {
    Embree::RayContext context{};
    std::uint32_t object = 0;  // on which the rays start
    bool is_one_ray = false;
    mutable std::uint32_t near_edges = 0;  // a bit for each ray that is to be traced on its own
    std::vector<TransparentHit>* hits = nullptr;
};

/// The cosine, times lengths, of the angle between a ray and the outer normal of the triangle that it hits:
/// positive where it leaves.
float leaving(const RTCFilterFunctionNArguments* hits, unsigned i) {
    const unsigned count = hits->N;
    return RTCRayN_dir_x(hits->ray, count, i) * RTCHitN_Ng_x(hits->hit, count, i) +
           RTCRayN_dir_y(hits->ray, count, i) * RTCHitN_Ng_y(hits->hit, count, i) +
           RTCRayN_dir_z(hits->ray, count, i) * RTCHitN_Ng_z(hits->hit, count, i);
}

bool is_near_edge(const RTCFilterFunctionNArguments* hits, unsigned i) {
    const float u = RTCHitN_u(hits->hit, hits->N, i), v = RTCHitN_v(hits->hit, hits->N, i);
    return std::min({u, v, 1 - u - v}) < k_near_edge;
}

/// Whether the surface blocks a ray that hits it.
bool is_blocking(const Surface& surface, bool is_own, std::uint32_t flags, float cosine) {
    if (surface.is_solid) return cosine < 0;
    if (!is_own || (flags & ShadowRays::k_from_below) == 0) return true;
    return (flags & ShadowRays::k_from_behind) != 0 ? cosine > 0 : cosine < 0;
}

/// A packet's hits of a solid object that is not transparent: lets light pass where it leaves. Hits near
/// edges are listed separately.
struct SolidLoop {
    CANDELA_BATCH_LOOP static void run(const RTCRayN* ray, const RTCHitN* hit, int* valid, int* near_edge,
                                       int* any) {
        const auto* const r = reinterpret_cast<const RTCRay16*>(ray);
        const auto* const h = reinterpret_cast<const RTCHit16*>(hit);
        int found = 0;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) {
            const float cosine =
                r->dir_x[i] * h->Ng_x[i] + r->dir_y[i] * h->Ng_y[i] + r->dir_z[i] * h->Ng_z[i];
            const float u = h->u[i], v = h->v[i], w = 1 - u - v;
            const float uv = u < v ? u : v, least = uv < w ? uv : w;
            const int blocked = cosine < 0 ? valid[i] : 0;
            const int at_edge = least < k_near_edge ? blocked : 0;
            near_edge[i] = at_edge;
            valid[i] = blocked ^ at_edge;
            found |= at_edge;
        }
        *any = found;
    }
};

/// Lets light pass where it leaves a solid object, or its own; and through transparent ones.
void let_pass(const RTCFilterFunctionNArguments* hits) {
    const auto& surface = *static_cast<const Surface*>(hits->geometryUserPtr);
    const auto& packet = *reinterpret_cast<const PacketContext*>(hits->context);
    if (hits->N == k_size && surface.is_solid && !surface.is_transparent && !packet.is_one_ray) {
        alignas(64) std::array<int, k_size> near_edge;
        int any = 0;
        int* const to = &any;
        multiversion<SolidLoop>(static_cast<const RTCRayN*>(hits->ray),
                                static_cast<const RTCHitN*>(hits->hit), hits->valid, near_edge.data(), to);
        for (unsigned i = 0; any != 0 && i < k_size; ++i) {
            if (near_edge[i] != 0) packet.near_edges |= 1u << (RTCRayN_id(hits->ray, k_size, i) % k_size);
        }
        return;
    }
    const bool is_own = surface.object == packet.object;
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] == 0) continue;
        const float cosine = leaving(hits, i);
        const std::uint32_t id = RTCRayN_id(hits->ray, hits->N, i), ray = id % k_size;
        const bool is_blocked = !surface.is_transparent && is_blocking(surface, is_own, id, cosine);
        if (!is_blocked) hits->valid[i] = 0;
        if (!is_blocked && !(surface.is_transparent && surface.has_inside)) continue;
        const bool is_at_edge = is_near_edge(hits, i);
        if (is_at_edge && !packet.is_one_ray) {
            packet.near_edges |= 1u << ray;
            hits->valid[i] = 0;
        } else if (!is_blocked) {
            packet.hits->push_back({ray, surface.object, RTCRayN_tfar(hits->ray, hits->N, i), cosine < 0,
                                    is_at_edge, RTCHitN_primID(hits->hit, hits->N, i)});
        }
    }
}

/// One over a packet's directions.
struct Inverse {
    alignas(64) std::array<float, k_size> x, y, z;
};

/// Sixteen rays for Embree.
struct PacketLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span origin, ConstVec3Span direction, const float* length,
                                       const std::uint32_t* flags, RTCRay16* rays, Inverse* inverse,
                                       int* valid) {
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
            // Not of zero, so that no product with it is NaN.
            inverse->x[i] = 1 / (direction.x[i] == 0 ? 1e-30f : direction.x[i]);
            inverse->y[i] = 1 / (direction.y[i] == 0 ? 1e-30f : direction.y[i]);
            inverse->z[i] = 1 / (direction.z[i] == 0 ? 1e-30f : direction.z[i]);
        }
    }
};

/// An object's box, and whether its own rays cannot meet it: it is solid, and convex.
struct Bounds {
    Box box;
    std::uint32_t object = 0;
    bool is_convex = false;
};

/// Enlarged by more than rounding may move a ray or a triangle, so that Embree finds no hit outside.
Box enlarged(const Box& box) {
    const auto magnitude = [](Vec3 v) { return std::max({std::abs(v.x), std::abs(v.y), std::abs(v.z)}); };
    const float by = 0x1p-16f * std::max(magnitude(box.low), magnitude(box.high));
    return {box.low - Vec3{by, by, by}, box.high + Vec3{by, by, by}};
}

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
    std::vector<Bounds> bounds;  // of the objects that cast shadows
    float largest = 0;           // extent of a triangle that blocks light on both sides
    bool has_transparent = false;

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { embree.release_scene(scene); }

    void add(const Mesh& mesh, Surface& surface) const;

    /// Whether rays that start on `object` come near any object that may block them.
    bool meets_any(const RTCRay16& rays, const Inverse& inverse, const std::array<int, k_size>& valid,
                   std::uint32_t object) const;

    /// Whether a ray is blocked if it is traced on its own. Adds its hits of transparent objects.
    bool is_blocked(const ShadowRays& rays, std::size_t ray, std::vector<TransparentHit>& hits) const;
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

OcclusionTree::OcclusionTree(std::span<const Occluder> occluders) : tree_(std::make_unique<Tree>()) {
    Tree& t = *tree_;
    std::uint64_t triangles = 0;
    for (const Occluder& each : occluders) {
        if (each.mesh != nullptr) triangles += each.mesh->triangle_count();
    }
    require_memory(triangles * k_bytes_per_triangle, "the tree of the triangles that cast shadows");
    t.surfaces.resize(occluders.size());
    for (std::size_t i = 0; i < occluders.size(); ++i) {
        const Occluder& occluder = occluders[i];
        if (occluder.mesh == nullptr || occluder.mesh->indices.empty()) continue;
        t.surfaces[i] = {.object = static_cast<std::uint32_t>(i),
                         .is_solid = occluder.is_solid,
                         .is_transparent = occluder.is_transparent,
                         .has_inside = occluder.mesh->open_edges == 0};
        t.has_transparent = t.has_transparent || occluder.is_transparent;
        if (!occluder.is_solid) t.largest = std::max(t.largest, largest_triangle(*occluder.mesh));
        t.add(*occluder.mesh, t.surfaces[i]);
        t.bounds.push_back({enlarged(occluder.mesh->bounds), t.surfaces[i].object,
                            occluder.is_solid && is_convex(*occluder.mesh)});
    }
    // Robust, so that no ray slips between triangles, and results do not depend on the shape of the tree.
    constexpr unsigned k_flags = unsigned{RTC_SCENE_FLAG_ROBUST} | unsigned{Embree::k_filters_by_call};
    // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): they are bits
    t.embree.set_scene_flags(t.scene, static_cast<RTCSceneFlags>(k_flags));
    t.embree.commit(t.scene, true);
    if (t.embree.get_device_error(t.embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

namespace {

/// A box that changes linearly with s: `at` + s `by`.
struct MovingBox {
    Box at;
    Vec3 low_by, high_by;
};

/// Whether it meets a box at any s from 0 to `end`.
bool meets(const MovingBox& moving, const Box& box, double end) {
    double begin = 0;
    const auto require = [&](double at, double by, double most) {  // at + s by <= most
        if (by > 0) end = std::min(end, (most - at) / by);
        if (by < 0) begin = std::max(begin, (most - at) / by);
        if (by == 0 && at > most) end = -1;
    };
    const auto along = [&](float Vec3::* axis) {
        require(double{moving.at.low.*axis}, double{moving.low_by.*axis}, double{box.high.*axis});
        require(-double{moving.at.high.*axis}, -double{moving.high_by.*axis}, -double{box.low.*axis});
    };
    along(&Vec3::x);
    along(&Vec3::y);
    along(&Vec3::z);
    return begin <= end;
}

/// With more, it would take longer than tracing a batch of rays.
constexpr std::size_t k_most_bounds = 256;

bool any_meets(const std::vector<Bounds>& bounds, std::uint32_t object, const MovingBox& moving, double end) {
    return bounds.size() > k_most_bounds || std::ranges::any_of(bounds, [&](const Bounds& each) {
               return !(each.is_convex && each.object == object) && meets(moving, each.box, end);
           });
}

}  // namespace

Box OcclusionTree::starting(const Box& points) const noexcept {
    const float margin = 4 * least_margin();
    const Box wide = enlarged(points);
    return {wide.low - Vec3{margin, margin, margin}, wide.high + Vec3{margin, margin, margin}};
}

bool OcclusionTree::may_block(const Box& points, const Box& light, std::uint32_t object) const noexcept {
    const Box from = starting(points);
    return any_meets(tree_->bounds, object, {from, light.low - from.low, light.high - from.high}, 1);
}

bool OcclusionTree::may_block(const Box& points, Vec3 towards, std::uint32_t object) const noexcept {
    return any_meets(tree_->bounds, object, {starting(points), towards, towards},
                     std::numeric_limits<double>::infinity());
}

OcclusionTree::OcclusionTree(OcclusionTree&&) noexcept = default;
OcclusionTree& OcclusionTree::operator=(OcclusionTree&&) noexcept = default;
OcclusionTree::~OcclusionTree() = default;

float OcclusionTree::least_margin() const noexcept { return k_relative_margin * tree_->largest; }
bool OcclusionTree::has_transparent() const noexcept { return tree_->has_transparent; }

namespace {

/// Removes all but one of the hits of a ray and an object, sorted by their distance, that are the same
/// crossing of an edge; and those that only touch it.
void merge_edges(std::vector<TransparentHit>& hits) {
    std::size_t kept = 0;
    for (std::size_t i = 0; i < hits.size();) {
        const TransparentHit first = hits[i];
        bool enters = first.enters, leaves = !first.enters;
        for (++i; i < hits.size() && first.is_near_edge && hits[i].is_near_edge && hits[i].ray == first.ray &&
                  hits[i].object == first.object && hits[i].along - first.along <= k_same_edge * first.along;
             ++i)
            (hits[i].enters ? enters : leaves) = true;
        if (enters != leaves) hits[kept++] = first;
    }
    hits.resize(kept);
}

/// Adds the ways of a packet's rays through transparent objects. `hits` is sorted and emptied.
void add_crossings(std::vector<TransparentHit>& hits, std::uint32_t first, const float* length,
                   std::vector<Crossing>& crossings) {
    const auto key = [](const TransparentHit& hit) {
        return std::tuple(hit.ray, hit.object, hit.along, hit.triangle);
    };
    std::ranges::sort(hits, {}, key);
    // A filter may be asked twice about one hit.
    hits.erase(std::ranges::unique(hits, {}, key).begin(), hits.end());
    merge_edges(hits);
    for (std::size_t i = 0; i < hits.size();) {
        const TransparentHit& hit = hits[i];
        float inside = 0;
        int open = 0;
        for (; i < hits.size() && hits[i].ray == hit.ray && hits[i].object == hit.object; ++i) {
            inside += hits[i].enters ? -hits[i].along : hits[i].along;
            open += hits[i].enters ? 1 : -1;
        }
        // A light inside the object: its light leaves once more than it enters.
        const float end = length[hit.ray];
        if (open > 0 && std::isfinite(end)) inside += static_cast<float>(open) * end;
        crossings.push_back({first + hit.ray, hit.object, std::max(inside, 0.0f)});
    }
    hits.clear();
}

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
                                     std::vector<TransparentHit>& hits) const {
    PacketContext context;
    context.object = rays.object;
    context.is_one_ray = true;
    context.hits = &hits;
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

void OcclusionTree::find_visible(const ShadowRays& rays, float* visible,
                                 std::vector<Crossing>& crossings) const {
    const Tree& t = *tree_;
    std::vector<TransparentHit> hits;
    PacketContext packet;
    packet.object = rays.object;
    packet.hits = &hits;
    for (std::size_t first = 0; first < rays.count; first += k_size) {
        const std::uint32_t* const flags = rays.flags + first;
        float* const to = visible + first;
        alignas(64) std::array<int, k_size> valid;
        RTCRay16 traced;
        Inverse inverse;
        Inverse* const to_inverse = &inverse;
        multiversion<PacketLoop>(rays.origin.from(first), rays.direction.from(first), rays.length + first,
                                 flags, &traced, to_inverse, valid.data());
        if (std::ranges::all_of(valid, [](int each) { return each == 0; }) ||
            !t.meets_any(traced, inverse, valid, rays.object)) {
            std::fill_n(to, k_size, 1.0f);
            continue;
        }
        packet.near_edges = 0;
        t.embree.occluded(t.scene, valid, let_pass, packet.context, traced);
        // Embree marks a blocked ray by a negative end.
        for (std::size_t i = 0; i < k_size; ++i) to[i] = valid[i] != 0 && traced.tfar[i] < 0 ? 0.0f : 1.0f;
        if (packet.near_edges != 0) {
            std::erase_if(hits,
                          [&](const TransparentHit& hit) { return (packet.near_edges >> hit.ray & 1) != 0; });
            for (std::size_t i = 0; i < k_size; ++i) {
                if ((packet.near_edges >> i & 1) != 0 && to[i] != 0 && t.is_blocked(rays, first + i, hits))
                    to[i] = 0;
            }
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
