module;

#include "candela/kernel/simd_dispatch.h"
#include "internal/embree_headers.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>
#include <vector>

module candela.geometry;

import :embree;
import :light_filter;

namespace candela {

namespace {

constexpr std::size_t k_size = OcclusionTree::k_packet;
static_assert(k_size == Embree::k_packet_size);

/// Where several triangles meet, Embree's answer depends on the packet's other rays. This close to an edge,
/// in barycentric coordinates, a ray is traced on its own.
constexpr float k_near_edge = 0x1p-12f;

/// Hits of a closed object in one sense are the same crossing, of an edge, if they are this close to each
/// other, relative to their distance.
constexpr float k_same_edge = 0x1p-10f;

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
    struct Found {
        int near_edge = 0, blocked = 0;  // not zero if there are any
    };
    CANDELA_BATCH_LOOP static void run(const RTCRayN* ray, const RTCHitN* hit, int* valid, int* near_edge,
                                       Found* any) {
        const auto* const r = reinterpret_cast<const RTCRay16*>(ray);
        const auto* const h = reinterpret_cast<const RTCHit16*>(hit);
        int at_edges = 0, all_blocked = 0;
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
            at_edges |= at_edge;
            all_blocked |= valid[i];
        }
        *any = {at_edges, all_blocked};
    }
};

}  // namespace

void let_pass(const RTCFilterFunctionNArguments* hits) {
    const auto& surface = *static_cast<const Surface*>(hits->geometryUserPtr);
    const auto& packet = *reinterpret_cast<const PacketContext*>(hits->context);
    const bool is_opaque = !surface.is_transparent && !surface.is_see_through;
    if (hits->N == k_size && surface.is_solid && is_opaque && !packet.is_one_ray) {
        alignas(64) std::array<int, k_size> near_edge;
        SolidLoop::Found any;
        SolidLoop::Found* const to = &any;
        multiversion<SolidLoop>(static_cast<const RTCRayN*>(hits->ray),
                                static_cast<const RTCHitN*>(hits->hit), hits->valid, near_edge.data(), to);
        for (unsigned i = 0; any.near_edge != 0 && i < k_size; ++i) {
            if (near_edge[i] != 0) packet.near_edges |= 1u << (RTCRayN_id(hits->ray, k_size, i) % k_size);
        }
        if (any.blocked != 0) {
            const auto i = static_cast<unsigned>(
                std::ranges::find_if(hits->valid, hits->valid + k_size, [](int each) { return each != 0; }) -
                hits->valid);
            packet.blocker = &surface;
            packet.blocker_triangle = RTCHitN_primID(hits->hit, k_size, i);
        }
        return;
    }
    const bool is_own = surface.object == packet.object;
    for (unsigned i = 0; i < hits->N; ++i) {
        if (hits->valid[i] == 0) continue;
        const float cosine = leaving(hits, i);
        const std::uint32_t id = RTCRayN_id(hits->ray, hits->N, i), ray = id % k_size;
        const bool is_met = !surface.is_transparent && is_blocking(surface, is_own, id, cosine);
        const bool is_blocked = is_met && is_opaque;
        if (!is_blocked) hits->valid[i] = 0;
        if (!is_met && !(surface.is_transparent && surface.has_inside)) continue;
        const bool is_at_edge = is_near_edge(hits, i);
        if (is_at_edge && !packet.is_one_ray) {
            packet.near_edges |= 1u << ray;
            hits->valid[i] = 0;
        } else if (surface.is_see_through) {
            if (packet.partial_hits == nullptr) continue;
            const float u = RTCHitN_u(hits->hit, hits->N, i), v = RTCHitN_v(hits->hit, hits->N, i);
            packet.partial_hits->push_back(
                {{ray, surface.object, RTCHitN_primID(hits->hit, hits->N, i), {1 - u - v, u, v}},
                 RTCRayN_tfar(hits->ray, hits->N, i),
                 cosine < 0,
                 is_at_edge});
        } else if (!is_blocked) {
            packet.hits->push_back({ray, surface.object, RTCRayN_tfar(hits->ray, hits->N, i), cosine < 0,
                                    is_at_edge, RTCHitN_primID(hits->hit, hits->N, i)});
        }
    }
}

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

}  // namespace

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

void add_passages(std::vector<PartialHit>& hits, std::uint32_t first, std::vector<Passage>& passages) {
    const auto key = [](const PartialHit& hit) {
        return std::tuple(hit.passage.ray, hit.passage.object, hit.along, hit.passage.triangle);
    };
    std::ranges::sort(hits, {}, key);
    hits.erase(std::ranges::unique(hits, {}, key).begin(), hits.end());
    const PartialHit* last = nullptr;
    for (const PartialHit& hit : hits) {
        // The triangles that share an edge are one surface there.
        const bool is_same = last != nullptr && last->is_near_edge && hit.is_near_edge &&
                             last->passage.ray == hit.passage.ray &&
                             last->passage.object == hit.passage.object && last->enters == hit.enters &&
                             hit.along - last->along <= k_same_edge * last->along;
        if (is_same) continue;
        last = &hit;
        passages.push_back(hit.passage);
        passages.back().ray += first;
    }
    hits.clear();
}

}  // namespace candela
