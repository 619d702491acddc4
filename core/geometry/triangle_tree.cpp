module;

#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"
#include "internal/embree_headers.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <new>
#include <span>

module candela.geometry;

import :embree;

namespace candela {

namespace {

using Eigen::Vector3d;
using Eigen::Vector3f;

constexpr std::size_t k_size = Embree::k_packet_size;

/// Lets rays pass where they enter: where they hit a triangle against its normal, or it has none.
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

/// If a ray hits two triangles at their common edge, Embree's answer depends on the packet's other rays. This
/// close to an edge, in barycentric coordinates, a ray is traced on its own.
constexpr double k_near_edge = 1e-4;

/// How far past its origin a ray may start, in multiples of a point's rounding error.
constexpr double k_margin = 16;

/// The largest magnitude that Embree can handle: its square is still finite.
constexpr float k_most = 1e18f;

/// Three numbers for each ray of a packet.
template <class T>
struct PacketArrays {
    alignas(64) T x[k_size];
    alignas(64) T y[k_size];
    alignas(64) T z[k_size];
};

using Mask = std::array<int, k_size>;  // -1 for active rays, otherwise 0, as Embree expects

struct Packet {
    PacketArrays<double> origin{};  // relative to the middle of the tree
    PacketArrays<float> direction{};
    alignas(64) Mask is_valid{};
};

/// The triangles through which a packet's rays supposedly leave, and where.
struct PacketExits {
    std::array<std::uint32_t, k_size> triangle;
    std::array<PacketArrays<float>, 3> corner;
    PacketArrays<float> barycentric;
    alignas(64) std::array<float, k_size> distance;
    alignas(64) Mask is_exit;  // the ray really passes from inside to outside there
    alignas(64) Mask is_sure;  // and not near an edge
};

/// A vector in double precision.
struct Exact {
    double x, y, z;
};

template <class T>
CANDELA_KERNEL_INLINE Exact exact(const PacketArrays<T>& v, std::size_t i) {
    return {static_cast<double>(v.x[i]), static_cast<double>(v.y[i]), static_cast<double>(v.z[i])};
}
CANDELA_KERNEL_INLINE Exact operator-(const Exact& a, const Exact& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
CANDELA_KERNEL_INLINE double triple_product(const Exact& a, const Exact& b, const Exact& c) {
    return a.x * (b.y * c.z - b.z * c.y) + a.y * (b.z * c.x - b.x * c.z) + a.z * (b.x * c.y - b.y * c.x);
}
CANDELA_KERNEL_INLINE double not_negative(double x) { return x > 0 ? x : 0; }
CANDELA_KERNEL_INLINE double min(double a, double b) { return b < a ? b : a; }

struct PacketLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, ConstVec3Span origin, ConstVec3Span direction,
                                       Exact middle, Packet* packet) {
        Packet& p = *packet;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < count; ++i) {
            p.origin.x[i] = static_cast<double>(origin.x[i]) - middle.x;
            p.origin.y[i] = static_cast<double>(origin.y[i]) - middle.y;
            p.origin.z[i] = static_cast<double>(origin.z[i]) - middle.z;
            p.direction.x[i] = direction.x[i];
            p.direction.y[i] = direction.y[i];
            p.direction.z[i] = direction.z[i];
            // A faulty plugin's rays would disturb the others, and end the process if Embree's assertions are
            // enabled.
            const float size = kernel::abs(static_cast<float>(p.origin.x[i])) +
                               kernel::abs(static_cast<float>(p.origin.y[i])) +
                               kernel::abs(static_cast<float>(p.origin.z[i])) + kernel::abs(direction.x[i]) +
                               kernel::abs(direction.y[i]) + kernel::abs(direction.z[i]);
            p.is_valid[i] = size < k_most ? -1 : 0;
        }
    }
};

/// Computed in double precision from the ray and the triangle, instead of from Embree's numbers.
struct ExitLoop {
    CANDELA_BATCH_LOOP static void run(const Packet* packet, PacketExits* exits) {
        const Packet& p = *packet;
        PacketExits& e = *exits;
        CANDELA_VECTORIZE_SIXTEEN
        for (std::size_t i = 0; i < k_size; ++i) {
            const Exact origin = exact(p.origin, i), towards = exact(p.direction, i);
            const Exact a = exact(e.corner[0], i) - origin, b = exact(e.corner[1], i) - origin,
                        c = exact(e.corner[2], i) - origin;
            // The volumes spanned by the ray and the edges; none is negative, even if rounding put the hit
            // outside the triangle.
            const double u = not_negative(triple_product(towards, b, c)),
                         v = not_negative(triple_product(towards, c, a)),
                         w = not_negative(triple_product(towards, a, b)), sum = u + v + w;
            const double scale = sum > 0 ? 1 / sum : 0;
            e.distance[i] = static_cast<float>(not_negative(triple_product(a, b, c) * scale));
            e.barycentric.x[i] = static_cast<float>(u * scale);
            e.barycentric.y[i] = static_cast<float>(v * scale);
            e.barycentric.z[i] = static_cast<float>(w * scale);
            e.is_exit[i] = sum > 0 ? -1 : 0;
            e.is_sure[i] = min(u, min(v, w)) * scale >= k_near_edge ? -1 : 0;
        }
    }
};

}  // namespace

/// Embree's tree of the triangles, moved to the origin, where floats are finest.
struct TriangleTree::Tree {
    const Embree& embree = Embree::instance();
    RTCScene scene = embree.new_scene(embree.device);
    std::span<const float> position;         // x y z of each vertex; Embree's own array
    std::span<const std::uint32_t> indices;  // also Embree's own array
    Vector3d middle = Vector3d::Zero();
    double rounding = 0;  // rounding error of a point on the surface, in float

    Tree() = default;
    Tree(const Tree&) = delete;
    Tree& operator=(const Tree&) = delete;
    ~Tree() { embree.release_scene(scene); }

    /// Whether, and where, the rays of the packet selected by `is_valid` leave, if they start at `start` from
    /// their origin and ignore what `filter` rejects.
    void trace(const Packet& packet, const Mask& is_valid, double start, RTCFilterFunctionN filter,
               PacketExits& exits) const;
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
        embree.commit_geometry(geometry);
        embree.attach_geometry(t.scene, geometry);
        // Robust, so that no ray slips between triangles.
        constexpr unsigned k_flags = unsigned{RTC_SCENE_FLAG_ROBUST} | unsigned{Embree::k_filters_by_call};
        // NOLINTNEXTLINE(clang-analyzer-optin.core.EnumCastOutOfRange): they are bits
        embree.set_scene_flags(t.scene, static_cast<RTCSceneFlags>(k_flags));
        embree.commit(t.scene);
    }
    embree.release_geometry(geometry);
    if (embree.get_device_error(embree.device) != RTC_ERROR_NONE) throw std::bad_alloc();
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

void TriangleTree::find_exits(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                              const RayExits& exits) const {
    std::fill_n(exits.distance, count, -1.0f);
    if (tree_ == nullptr) return;
    const Tree& t = *tree_;
    const Exact middle{t.middle.x(), t.middle.y(), t.middle.z()};
    for (std::size_t first = 0; first < count; first += k_size) {
        const std::size_t here = std::min(k_size, count - first);
        Packet packet;
        multiversion<PacketLoop>(here, origin.from(first), direction.from(first), middle, &packet);
        PacketExits found;
        // Past the surface on which a ray starts, the first hit is nearly always where it leaves.
        t.trace(packet, packet.is_valid, k_margin * t.rounding, nullptr, found);
        for (std::size_t i = 0; i < here; ++i) {
            if (packet.is_valid[i] == 0) continue;
            PacketExits* exit = &found;
            PacketExits alone;
            if (found.is_sure[i] == 0) {
                // The ray hit near an edge, or an entry, or missed an exit close to its origin. Starts a
                // little earlier, since rounding may put a point of the surface past it.
                Mask only{};
                only[i] = -1;
                t.trace(packet, only, -t.rounding, ignore_entries, alone);
                exit = &alone;
            }
            if (exit->is_exit[i] == 0) continue;
            exits.triangle[first + i] = exit->triangle[i];
            exits.distance[first + i] = exit->distance[i];
            exits.barycentric.set(first + i,
                                  {exit->barycentric.x[i], exit->barycentric.y[i], exit->barycentric.z[i]});
        }
    }
}

void TriangleTree::Tree::trace(const Packet& packet, const Mask& is_valid, double start,
                               RTCFilterFunctionN filter, PacketExits& exits) const {
    alignas(64) const Mask valid = is_valid;
    RTCRayHit16 rays{};
    const auto ahead = static_cast<float>(std::max(start, 0.0));
    const double back = std::min(start, 0.0);
    for (std::size_t i = 0; i < k_size; ++i) {
        const Exact d = exact(packet.direction, i);
        rays.ray.org_x[i] = static_cast<float>(packet.origin.x[i] + back * d.x);
        rays.ray.org_y[i] = static_cast<float>(packet.origin.y[i] + back * d.y);
        rays.ray.org_z[i] = static_cast<float>(packet.origin.z[i] + back * d.z);
        rays.ray.dir_x[i] = packet.direction.x[i];
        rays.ray.dir_y[i] = packet.direction.y[i];
        rays.ray.dir_z[i] = packet.direction.z[i];
        rays.ray.tnear[i] = ahead;
        rays.ray.tfar[i] = std::numeric_limits<float>::infinity();
        rays.ray.mask[i] = ~0u;
        rays.hit.geomID[i] = RTC_INVALID_GEOMETRY_ID;
    }
    Embree::RayContext context;
    embree.trace(scene, valid, filter, context, rays);
    for (std::size_t i = 0; i < k_size; ++i) {
        const bool is_hit = valid[i] != 0 && rays.hit.geomID[i] != RTC_INVALID_GEOMETRY_ID;
        exits.triangle[i] = is_hit ? rays.hit.primID[i] : 0;
        const std::uint32_t* const corner = &indices[3 * std::size_t{exits.triangle[i]}];
        for (std::size_t k = 0; k < 3; ++k) {
            // A ray without a hit gets a degenerate triangle, which is not an exit.
            const float* const vertex = &position[3 * std::size_t{corner[is_hit ? k : 0]}];
            exits.corner[k].x[i] = vertex[0];
            exits.corner[k].y[i] = vertex[1];
            exits.corner[k].z[i] = vertex[2];
        }
    }
    multiversion<ExitLoop>(&packet, &exits);
}

}  // namespace candela
