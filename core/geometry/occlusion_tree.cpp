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

/// With more objects, it is cheaper to trace all rays of a convex one.
constexpr std::size_t k_most_boxes = 32;

/// Embree passes it to the filter with each hit of the surface.
struct Surface {
    std::uint32_t object = 0;
    bool is_solid = false;
    bool is_transparent = false;
    bool has_inside = false;
    bool is_convex = false;
    std::optional<Box> bounds{};  // nothing if it casts no shadow
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
        multiversion<SolidLoop>(static_cast<const RTCRayN*>(hits->ray),
                                static_cast<const RTCHitN*>(hits->hit), hits->valid, near_edge.data(), &any);
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

/// Sixteen rays for Embree.
struct PacketLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span origin, ConstVec3Span direction, const float* length,
                                       const std::uint32_t* flags, RTCRay16* rays, int* valid) {
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
        }
    }
};

/// Turns off the rays that meet no box: those of a convex object, which does not block its own light.
/// `boxes`: of the others.
struct CullLoop {
    CANDELA_BATCH_LOOP static void run(const RTCRay16* rays, const Box* boxes, std::size_t count,
                                       int* valid) {
        alignas(64) float inverse[3][k_size];
        alignas(64) int reaches[k_size] = {};
        const float* const direction[3] = {rays->dir_x, rays->dir_y, rays->dir_z};
        for (std::size_t axis = 0; axis < 3; ++axis) {
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t i = 0; i < k_size; ++i) {
                const float d = direction[axis][i];
                const float small = d < 0.0f ? -1.0e-30f : 1.0e-30f;
                inverse[axis][i] = 1.0f / (kernel::abs(d) < 1.0e-30f ? small : d);
            }
        }
        for (const Box *box = boxes, *const end = boxes + count; box != end; ++box) {
            const Vec3 low = box->low, high = box->high;
            CANDELA_VECTORIZE_SIXTEEN
            for (std::size_t i = 0; i < k_size; ++i) {
                const float x0 = (low.x - rays->org_x[i]) * inverse[0][i];
                const float x1 = (high.x - rays->org_x[i]) * inverse[0][i];
                const float y0 = (low.y - rays->org_y[i]) * inverse[1][i];
                const float y1 = (high.y - rays->org_y[i]) * inverse[1][i];
                const float z0 = (low.z - rays->org_z[i]) * inverse[2][i];
                const float z1 = (high.z - rays->org_z[i]) * inverse[2][i];
                const float near = kernel::max(kernel::max(kernel::min(x0, x1), kernel::min(y0, y1)),
                                               kernel::max(kernel::min(z0, z1), 0.0f));
                const float far = kernel::min(kernel::min(kernel::max(x0, x1), kernel::max(y0, y1)),
                                              kernel::min(kernel::max(z0, z1), rays->tfar[i]));
                // Rounding must not lose a ray that grazes the box.
                reaches[i] |= near <= far * 1.00001f ? -1 : 0;
            }
        }
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) valid[i] &= reaches[i];
    }
};

/// The box with a margin, so that it contains all that a ray may hit in spite of rounding.
Box widened(Box box) {
    constexpr float k_margin = 16 * OcclusionTree::k_relative_margin;
    const auto wide = [](float low, float high) { return k_margin * (std::abs(low) + std::abs(high)); };
    const Vec3 by{wide(box.low.x, box.high.x), wide(box.low.y, box.high.y), wide(box.low.z, box.high.z)};
    return {box.low - by, box.high + by};
}

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
    float largest = 0;  // extent of a triangle that blocks light on both sides
    bool has_transparent = false;

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { embree.release_scene(scene); }

    void add(const Mesh& mesh, Surface& surface) const;

    /// If the object is convex, the boxes of all others, and how many there are; unless there are too many.
    std::optional<std::size_t> boxes_around_convex(std::uint32_t object,
                                                   std::array<Box, k_most_boxes>& boxes) const {
        if (object >= surfaces.size() || !surfaces[object].is_convex) return std::nullopt;
        std::size_t count = 0;
        for (const Surface& surface : surfaces) {
            if (surface.object == object || !surface.bounds) continue;
            if (count == k_most_boxes) return std::nullopt;
            boxes[count++] = *surface.bounds;
        }
        return count;
    }

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
                         .has_inside = occluder.mesh->open_edges == 0,
                         .is_convex = occluder.is_solid && occluder.mesh->is_convex,
                         .bounds = widened(occluder.mesh->bounds)};
        t.has_transparent = t.has_transparent || occluder.is_transparent;
        if (!occluder.is_solid) t.largest = std::max(t.largest, largest_triangle(*occluder.mesh));
        t.add(*occluder.mesh, t.surfaces[i]);
    }
    // Robust, so that no ray slips between triangles, and results do not depend on the shape of the tree.
    constexpr unsigned k_flags = unsigned{RTC_SCENE_FLAG_ROBUST} | unsigned{Embree::k_filters_by_call};
    // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): they are bits
    t.embree.set_scene_flags(t.scene, static_cast<RTCSceneFlags>(k_flags));
    t.embree.commit(t.scene, true);
    if (t.embree.get_device_error(t.embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
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

void OcclusionTree::find_visible(const ShadowRays& rays, float* visible,
                                 std::vector<Crossing>& crossings) const {
    const Tree& t = *tree_;
    std::vector<TransparentHit> hits;
    PacketContext packet;
    packet.object = rays.object;
    packet.hits = &hits;
    std::array<Box, k_most_boxes> others;
    const std::optional<std::size_t> other_count = t.boxes_around_convex(rays.object, others);
    for (std::size_t first = 0; first < rays.count; first += k_size) {
        const std::uint32_t* const flags = rays.flags + first;
        float* const to = visible + first;
        alignas(64) std::array<int, k_size> valid;
        RTCRay16 traced;
        multiversion<PacketLoop>(rays.origin.from(first), rays.direction.from(first), rays.length + first,
                                 flags, &traced, valid.data());
        if (other_count) multiversion<CullLoop>(&traced, others.data(), *other_count, valid.data());
        if (std::ranges::all_of(valid, [](int each) { return each == 0; })) {
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
