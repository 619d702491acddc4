module;

#include "candela/kernel/simd_dispatch.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

module candela.geometry;

import candela.api;
import candela.util;

namespace candela {

namespace {

/// Metres. Squared areas must also be representable as floats.
constexpr float k_farthest = 1e9f;

/// The approximate memory for a mesh while it is made, checked and drawn.
std::uint64_t memory_for(const MeshLayout& layout, std::size_t channels) {
    const std::uint64_t vectors = 7u + (layout.has_normals ? 1u : 0u) + (layout.has_uv ? 1u : 0u) +
                                  (layout.has_derivatives ? 2u : 0u) + (layout.has_color ? 1u : 0u);
    constexpr std::uint64_t k_vector = 3 * sizeof(float);
    constexpr std::uint64_t k_triangle = 3 * sizeof(std::uint32_t) + k_vector + 40;  // projected
    const bool is_counted = layout.closedness != Closedness::unknown && layout.closedness != Closedness::open;
    const std::uint64_t edges = is_counted ? 0 : 3 * 8;
    const std::uint64_t vertex = vectors * k_vector + (layout.has_channels ? channels * sizeof(float) : 0);
    return layout.vertices * vertex + layout.triangles * (k_triangle + edges);
}

/// Receives what a shape writes, before it is transformed.
class Collector final : public MeshSink {
  public:
    Collector(const MeshRequest& request, const std::function<void(double)>& progress)
        : takes_facets_(request.facets), channels_(request.channels), progress_(progress) {}

    MeshSpans allocate(const MeshLayout& layout) override {
        if (allocated_) throw std::logic_error("the shape requested its arrays twice");
        allocated_ = true;
        if (layout.is_faceted && !takes_facets_)
            throw std::logic_error("the shape is faceted, though no facets were requested");
        mesh.is_faceted = layout.is_faceted;
        constexpr std::size_t k_most = 0xffff'fff0u;
        if (layout.vertices > k_most || layout.triangles > k_most / 3) {
            throw std::invalid_argument(
                fmt::format("{} triangles are more than can be numbered", layout.triangles));
        }
        require_memory(memory_for(layout, channels_.size()),
                       fmt::format("a shape of {} triangles", layout.triangles));
        closedness = layout.closedness;
        open_edges = layout.open_edges;
        mesh.position.resize(layout.vertices);
        mesh.indices.resize(3 * layout.triangles);
        if (layout.has_normals) authored_normal.resize(layout.vertices);
        if (layout.has_uv) {
            mesh.u.resize(layout.vertices);
            mesh.v.resize(layout.vertices);
        }
        if (layout.has_derivatives) {
            mesh.dpdu.resize(layout.vertices);
            mesh.dpdv.resize(layout.vertices);
        }
        if (layout.has_color) mesh.color.resize(layout.vertices);
        if (layout.has_smooth_groups) smooth_group.resize(layout.vertices);
        if (!channels_.empty() && !layout.has_channels)
            throw std::invalid_argument(
                fmt::format("there is no vertex attribute '{}': only meshes from files have any",
                            channels_[0].attribute));
        mesh.channels.resize(channels_.size());
        mesh.has_second_uv = !channels_.empty() && channels_[0].attribute == "uv1";
        for (AlignedVector<float>& channel : mesh.channels) {
            channel.resize(layout.vertices);
            channel_pointers_.push_back(channel.data());
        }
        const auto optional = [](Vec3Arrays& arrays) { return arrays.empty() ? Vec3Span{} : arrays.span(); };
        return {.position = mesh.position.span(),
                .indices = mesh.indices,
                .normal = optional(authored_normal),
                .uv = mesh.u.empty() ? Vec2Span{} : Vec2Span{mesh.u.data(), mesh.v.data()},
                .dpdu = optional(mesh.dpdu),
                .dpdv = optional(mesh.dpdv),
                .smooth_group = smooth_group,
                .color = optional(mesh.color),
                .channels = channel_pointers_};
    }

    void warn(std::string_view sentence) override { warnings.emplace_back(sentence); }
    void progress(double fraction) override {
        if (progress_) progress_(fraction);
    }

    Mesh mesh;
    Vec3Arrays authored_normal;
    AlignedVector<std::uint32_t> smooth_group;
    Closedness closedness = Closedness::unknown;
    std::size_t open_edges = 0;
    std::vector<std::string> warnings;

  private:
    bool takes_facets_;
    std::span<const VertexChannel> channels_;
    std::vector<float*> channel_pointers_;
    const std::function<void(double)>& progress_;
    bool allocated_ = false;
};

/// As many floats as fit into the cache.
constexpr Eigen::Index k_stretch = 1024;
using Stretch = Eigen::Array<float, Eigen::Dynamic, 1, Eigen::ColMajor, k_stretch, 1>;
using Rows = Eigen::Map<Eigen::ArrayXf>;

/// Applies `linear` and then `offset` to every vector of the arrays.
void transform(Vec3Arrays& arrays, const Eigen::Matrix3f& linear, const Eigen::Vector3f& offset) {
    if (arrays.empty()) return;
    const auto count = static_cast<Eigen::Index>(arrays.size());
    for (Eigen::Index first = 0; first < count; first += k_stretch) {
        const Eigen::Index some = std::min(k_stretch, count - first);
        Rows x(arrays.x.data() + first, some), y(arrays.y.data() + first, some),
            z(arrays.z.data() + first, some);
        const Stretch a = linear(0, 0) * x + linear(0, 1) * y + linear(0, 2) * z + offset[0];
        const Stretch b = linear(1, 0) * x + linear(1, 1) * y + linear(1, 2) * z + offset[1];
        const Stretch c = linear(2, 0) * x + linear(2, 1) * y + linear(2, 2) * z + offset[2];
        x = a;
        y = b;
        z = c;
    }
}

void normalize(Vec3Arrays& arrays) {
    const Vec3Span span = arrays.span();
    for (std::size_t i = 0; i < arrays.size(); ++i) span.set(i, normalized(span[i]));
}

Eigen::Matrix3f linear_part(const Transform& transform) {
    const auto turn = [](float degrees, const Eigen::Vector3f& axis) {
        return Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis);
    };
    const Eigen::Matrix3f rotation = (turn(transform.rotation.z, Eigen::Vector3f::UnitZ()) *
                                      turn(transform.rotation.y, Eigen::Vector3f::UnitY()) *
                                      turn(transform.rotation.x, Eigen::Vector3f::UnitX()))
                                         .toRotationMatrix();
    return rotation * Eigen::Vector3f(transform.scale.x, transform.scale.y, transform.scale.z).asDiagonal();
}

bool are_near(const AlignedVector<float>& coordinates) {
    bool are = true;
    for (const float x : coordinates) are &= std::abs(x) <= k_farthest;  // false for NaN
    return are;
}

void check_finite(const Mesh& mesh) {
    if (are_near(mesh.position.x) && are_near(mesh.position.y) && are_near(mesh.position.z)) return;
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 p = mesh.position.span()[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw std::invalid_argument(fmt::format("the position of vertex {} is non-finite", i));
        }
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > k_farthest) {
            throw Error(ErrorCategory::invalid_scene,
                        fmt::format("vertex {} at [{:g}, {:g}, {:g}] is more than {:g} m away", i, p.x, p.y,
                                    p.z, k_farthest));
        }
    }
}

void check_colors(const Mesh& mesh) {
    const auto is_intensity = [](float c) { return c >= 0 && c <= 1; };  // false for NaN
    for (std::size_t i = 0; i < mesh.color.size(); ++i) {
        const Vec3 c = mesh.color.span()[i];
        if (!is_intensity(c.x) || !is_intensity(c.y) || !is_intensity(c.z))
            throw std::invalid_argument(
                fmt::format("the colour of vertex {} is [{:g}, {:g}, {:g}], which is not within 0 to 1", i,
                            c.x, c.y, c.z));
    }
}

void check(const Collector& collected) {
    const Mesh& mesh = collected.mesh;
    if (mesh.indices.empty()) throw std::invalid_argument("the mesh has no triangles");
    for (const std::uint32_t corner : mesh.indices) {
        if (corner >= mesh.vertex_count()) {
            throw std::invalid_argument(
                fmt::format("a triangle refers to vertex {}, but there are only {} vertices", corner,
                            mesh.vertex_count()));
        }
    }
    check_finite(mesh);
    check_colors(mesh);
    for (const std::uint32_t group : collected.smooth_group) {
        if (group >= mesh.vertex_count()) {
            throw std::invalid_argument(fmt::format("smooth group {} is out of range: there are {} vertices",
                                                    group, mesh.vertex_count()));
        }
    }
}

/// The number of triangles or vertices that is worth a thread's while.
constexpr std::size_t k_per_task = 16384;

/// CA DD8, in double: the product of two short edges must not underflow.
struct FaceNormalLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span position, const std::uint32_t* indices,
                                       std::size_t count, Vec3Span normal) {
        CANDELA_VECTORIZE
// Wider than doubles require, because most of the work is fetching floats.
#pragma clang loop vectorize_width(16)
        for (std::size_t t = 0; t < count; ++t) {
            const Vec3 a = position[indices[3 * t]];
            const Vec3 p = position[indices[3 * t + 1]] - a;
            const Vec3 q = position[indices[3 * t + 2]] - a;
            const double px = p.x, py = p.y, pz = p.z, qx = q.x, qy = q.y, qz = q.z;
            const double x = py * qz - pz * qy, y = pz * qx - px * qz, z = px * qy - py * qx;
            const double size = std::sqrt(x * x + y * y + z * z);
            const double scale = size > 0 ? 1 / size : 0;
            normal.x[t] = static_cast<float>(scale * x);
            normal.y[t] = static_cast<float>(scale * y);
            normal.z[t] = static_cast<float>(scale * z);
        }
    }
};

/// The number of edges that are not shared by two triangles that agree on which side is outside. Vertices at
/// the same position count as one.
std::size_t count_open_edges(const Mesh& mesh) {
    const std::vector<std::uint32_t> place = welded(mesh.position.span(), mesh.vertex_count());
    struct Edge {
        std::uint32_t end;  // the higher position
        std::int32_t direction;
    };
    const auto each_edge = [&](auto visit) {
        for (std::size_t corner = 0; corner < mesh.indices.size(); ++corner) {
            const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
            const std::uint32_t a = place[mesh.indices[corner]], b = place[mesh.indices[next]];
            if (a != b) visit(std::min(a, b), Edge{std::max(a, b), a < b ? 1 : -1});
        }
    };
    // Sorts edges by their lower position. `begin` advances to where the next edge is stored, and ends where
    // the next position's edges begin.
    std::vector<std::uint32_t> begin(mesh.vertex_count() + 1);
    each_edge([&](std::uint32_t low, Edge) { ++begin[low + 1]; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    std::vector<Edge> edges(begin.back());
    each_edge([&](std::uint32_t low, Edge edge) { edges[begin[low]++] = edge; });
    // On a closed surface the directions of an edge sum to zero.
    std::size_t open = 0, first = 0;
    for (const std::size_t end : begin) {
        std::ranges::sort(std::span(edges).subspan(first, end - first), {}, &Edge::end);
        while (first < end) {
            const std::uint32_t to = edges[first].end;
            std::int64_t balance = 0;
            for (; first < end && edges[first].end == to; ++first) balance += edges[first].direction;
            if (balance != 0) ++open;
        }
    }
    return open;
}

/// A normal for each smooth group, or for each vertex if there are none.
Vec3Arrays group_normals(const PlacedShape& placed, const ShadingModel& shading) {
    const Mesh& mesh = placed.mesh;
    const std::size_t count = mesh.vertex_count();
    const bool has_groups = !placed.smooth_group.empty();
    AlignedVector<std::uint32_t> each_its_own;
    if (!has_groups) {
        each_its_own.resize(count);
        std::iota(each_its_own.begin(), each_its_own.end(), 0u);
    }
    Vec3Arrays normal;
    constexpr std::size_t k_guard_size = 16;
    normal.resize(count + k_guard_size);
    for (AlignedVector<float>* const array : {&normal.x, &normal.y, &normal.z})
        fill_with_canary(std::span(*array).subspan(count));
    const MeshView view{
        .position = mesh.position.span(),
        .indices = mesh.indices,
        .face_normal = mesh.face_normal.span(),
        .smooth_group = has_groups ? placed.smooth_group : each_its_own,
        .vertex_count = count,
        .group_count = count,
        .authored_normal = placed.authored_normal.empty() ? ConstVec3Span{} : placed.authored_normal.span()};
    shading.vertex_normals(view, normal.span());
    for (const AlignedVector<float>* const array : {&normal.x, &normal.y, &normal.z}) {
        if (!is_canary_intact(std::span(*array).subspan(count)))
            throw std::invalid_argument("it writes more vertex normals than there are vertices");
    }
    return normal;
}

/// Calls visit(vertex, normal) for all vertices, on several threads. Throws std::invalid_argument if a normal
/// is non-finite.
template <class Visit>
void for_each_vertex_normal(const PlacedShape& placed, const ShadingModel& shading, const Visit& visit) {
    const Vec3Arrays of_groups = group_normals(placed, shading);
    const bool has_groups = !placed.smooth_group.empty();
    const auto normal_of = [&, normals = of_groups.span()](std::size_t vertex) {
        return normals[has_groups ? placed.smooth_group[vertex] : vertex];
    };
    const auto is_finite = [](Vec3 n) { return std::isfinite(n.x + n.y + n.z); };
    const std::size_t count = placed.mesh.vertex_count();
    std::atomic<bool> are_finite{true};
    parallel_for(count, k_per_task, [&](std::size_t begin, std::size_t end) {
        bool are = true;
        for (std::size_t i = begin; i < end; ++i) {
            const Vec3 n = normal_of(i);
            visit(i, n);
            are &= is_finite(n);
        }
        if (!are) are_finite = false;
    });
    if (are_finite) return;
    // The first one, whichever thread found it.
    std::size_t first = 0;
    while (is_finite(normal_of(first))) ++first;
    throw std::invalid_argument(fmt::format("its normal for vertex {} is non-finite", first));
}

}  // namespace

PlacedShape place(const Shape& shape, const MeshRequest& request, const Transform& to_world,
                  const std::function<void(double)>& progress) {
    Collector collected(request, progress);
    shape.tessellate(request, collected);
    check(collected);

    Mesh mesh = std::move(collected.mesh);
    const Eigen::Matrix3f linear = linear_part(to_world);
    transform(mesh.position, linear, {to_world.position.x, to_world.position.y, to_world.position.z});
    transform(mesh.dpdu, linear, Eigen::Vector3f::Zero());
    transform(mesh.dpdv, linear, Eigen::Vector3f::Zero());
    check_finite(mesh);
    mesh.bounds = box_around(std::as_const(mesh.position).span(), mesh.vertex_count());
    if (!collected.authored_normal.empty()) {
        transform(collected.authored_normal, linear.inverse().transpose(), Eigen::Vector3f::Zero());
        normalize(collected.authored_normal);
    }
    mesh.is_convex = collected.closedness == Closedness::convex;
    if (mesh.is_convex || collected.closedness == Closedness::closed) {
        mesh.closed = true;
    } else {
        mesh.one_sided = collected.closedness == Closedness::one_sided;
        const bool are_counted =
            mesh.one_sided || (collected.closedness == Closedness::open && collected.open_edges > 0);
        mesh.open_edges = are_counted ? collected.open_edges : count_open_edges(mesh);
        mesh.closed = mesh.open_edges == 0 || mesh.one_sided;
    }
    return {std::move(mesh), std::move(collected.authored_normal), std::move(collected.smooth_group),
            std::move(collected.warnings)};
}

void make_face_normals(Mesh& mesh) {
    mesh.face_normal.resize(mesh.triangle_count());
    parallel_for(mesh.triangle_count(), k_per_task, [&](std::size_t begin, std::size_t end) {
        const std::uint32_t* const indices = &mesh.indices[3 * begin];
        multiversion<FaceNormalLoop>(std::as_const(mesh.position).span(), indices, end - begin,
                                     mesh.face_normal.span().from(begin));
    });
}

Vec3Arrays vertex_normals(const PlacedShape& placed, const ShadingModel& shading) {
    Vec3Arrays normals;
    normals.resize(placed.mesh.vertex_count());
    for_each_vertex_normal(placed, shading,
                           [to = normals.span()](std::size_t i, Vec3 normal) { to.set(i, normal); });
    return normals;
}

Mesh with_normals(PlacedShape placed, const ShadingModel& shading) {
    Mesh& mesh = placed.mesh;
    make_face_normals(mesh);
    mesh.vertices.resize(mesh.vertex_count());
    if (mesh.is_faceted) {
        parallel_for(mesh.vertex_count(), k_per_task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t i = begin; i < end; ++i)
                mesh.vertices[i] = {.position = std::as_const(mesh.position).span()[i], .normal = {}};
        });
        return std::move(placed.mesh);
    }
    for_each_vertex_normal(placed, shading, [&](std::size_t i, Vec3 normal) {
        mesh.vertices[i] = {.position = std::as_const(mesh.position).span()[i], .normal = normal};
    });
    return std::move(placed.mesh);
}

Mesh build_mesh(const Shape& shape, const MeshRequest& request, const Transform& transform,
                const ShadingModel& shading) {
    return with_normals(place(shape, request, transform), shading);
}

}  // namespace candela
