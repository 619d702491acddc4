module;

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

module candela.mesh;

import candela.geometry;
import candela.memory;

namespace candela {

namespace {

/// Metres. Squares of areas are floats, too.
constexpr float k_farthest = 1e9f;

/// Roughly what a mesh takes while it is made, checked and drawn.
std::uint64_t memory_for(const MeshLayout& layout) {
    const std::uint64_t vectors =
        5u + (layout.has_normals ? 1u : 0u) + (layout.has_uv ? 1u : 0u) + (layout.has_derivatives ? 2u : 0u);
    constexpr std::uint64_t k_vector = 3 * sizeof(float);
    constexpr std::uint64_t k_triangle = 3 * sizeof(std::uint32_t) + k_vector + 40;  // projected
    const std::uint64_t edges = layout.closedness == Closedness::closed ? 0 : 3 * 16;
    return layout.vertices * vectors * k_vector + layout.triangles * (k_triangle + edges);
}

/// What a shape writes, before it is placed.
class Collector final : public MeshSink {
  public:
    MeshSpans allocate(const MeshLayout& layout) override {
        if (allocated_) throw std::logic_error("the shape asked for its arrays twice");
        allocated_ = true;
        constexpr std::size_t k_most = 0xffff'fff0u;
        if (layout.vertices > k_most || layout.triangles > k_most / 3) {
            throw std::invalid_argument(
                fmt::format("{} triangles are more than can be numbered", layout.triangles));
        }
        require_memory(memory_for(layout), fmt::format("a shape of {} triangles", layout.triangles));
        closedness = layout.closedness;
        mesh.position.resize(layout.vertices);
        mesh.corners.resize(3 * layout.triangles);
        if (layout.has_normals) authored_normal.resize(layout.vertices);
        if (layout.has_uv) {
            mesh.u.resize(layout.vertices);
            mesh.v.resize(layout.vertices);
        }
        if (layout.has_derivatives) {
            mesh.dpdu.resize(layout.vertices);
            mesh.dpdv.resize(layout.vertices);
        }
        if (layout.has_smooth_groups) smooth_group.resize(layout.vertices);
        const auto optional = [](Vec3Arrays& arrays) { return arrays.empty() ? Vec3Span{} : arrays.span(); };
        return {.position = mesh.position.span(),
                .corners = mesh.corners,
                .normal = optional(authored_normal),
                .uv = mesh.u.empty() ? Vec2Span{} : Vec2Span{mesh.u.data(), mesh.v.data()},
                .dpdu = optional(mesh.dpdu),
                .dpdv = optional(mesh.dpdv),
                .smooth_group = smooth_group};
    }

    Mesh mesh;
    Vec3Arrays authored_normal;
    std::vector<std::uint32_t> smooth_group;
    Closedness closedness = Closedness::unknown;

  private:
    bool allocated_ = false;
};

using Rows = Eigen::Map<Eigen::ArrayXf>;

/// Applies `linear` and then `offset` to every vector of the arrays.
void transform(Vec3Arrays& arrays, const Eigen::Matrix3f& linear, const Eigen::Vector3f& offset) {
    if (arrays.empty()) return;
    const auto count = static_cast<Eigen::Index>(arrays.size());
    Rows x(arrays.x.data(), count), y(arrays.y.data(), count), z(arrays.z.data(), count);
    const Eigen::ArrayXf a = linear(0, 0) * x + linear(0, 1) * y + linear(0, 2) * z + offset[0];
    const Eigen::ArrayXf b = linear(1, 0) * x + linear(1, 1) * y + linear(1, 2) * z + offset[1];
    const Eigen::ArrayXf c = linear(2, 0) * x + linear(2, 1) * y + linear(2, 2) * z + offset[2];
    x = a;
    y = b;
    z = c;
}

void normalize(Vec3Arrays& arrays) {
    const Vec3Span span = arrays.span();
    for (std::size_t i = 0; i < arrays.size(); ++i) span.set(i, normalized(span[i]));
}

Eigen::Matrix3f linear_part(const Placement& placement) {
    const auto turn = [](float degrees, const Eigen::Vector3f& axis) {
        return Eigen::AngleAxisf(degrees * std::numbers::pi_v<float> / 180, axis);
    };
    const Eigen::Matrix3f rotation = (turn(placement.rotation.z, Eigen::Vector3f::UnitZ()) *
                                      turn(placement.rotation.y, Eigen::Vector3f::UnitY()) *
                                      turn(placement.rotation.x, Eigen::Vector3f::UnitX()))
                                         .toRotationMatrix();
    return rotation * Eigen::Vector3f(placement.scale.x, placement.scale.y, placement.scale.z).asDiagonal();
}

void check_finite(const Mesh& mesh) {
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 p = mesh.position.span()[i];
        if (!std::isfinite(p.x) || !std::isfinite(p.y) || !std::isfinite(p.z)) {
            throw std::invalid_argument(fmt::format("the position of vertex {} is not a finite number", i));
        }
        if (std::max({std::abs(p.x), std::abs(p.y), std::abs(p.z)}) > k_farthest) {
            throw std::invalid_argument(fmt::format(
                "vertex {} at [{:g}, {:g}, {:g}] is farther away than {:g} m", i, p.x, p.y, p.z, k_farthest));
        }
    }
}

void check(const Collector& collected) {
    const Mesh& mesh = collected.mesh;
    if (mesh.corners.empty()) throw std::invalid_argument("the mesh has no triangles");
    for (const std::uint32_t corner : mesh.corners) {
        if (corner >= mesh.vertex_count()) {
            throw std::invalid_argument(
                fmt::format("a triangle's corner is vertex {}, but there are only {} vertices", corner,
                            mesh.vertex_count()));
        }
    }
    check_finite(mesh);
    for (const std::uint32_t group : collected.smooth_group) {
        if (group >= mesh.vertex_count()) {
            throw std::invalid_argument(
                fmt::format("smooth group {} is beyond the {} vertices", group, mesh.vertex_count()));
        }
    }
}

void make_face_normals(Mesh& mesh) {
    mesh.face_normal.resize(mesh.triangle_count());
    const ConstVec3Span position = std::as_const(mesh.position).span();
    for (std::size_t t = 0; t < mesh.triangle_count(); ++t) {
        const Vec3 a = position[mesh.corners[3 * t]];
        const Vec3 p = position[mesh.corners[3 * t + 1]] - a;
        const Vec3 q = position[mesh.corners[3 * t + 2]] - a;
        // CA DD8, in double: the product of two short edges must not vanish.
        const Eigen::Vector3d n = Eigen::Vector3d(p.x, p.y, p.z).cross(Eigen::Vector3d(q.x, q.y, q.z));
        const double size = n.norm();
        if (size > 0) {
            const Eigen::Vector3f unit = (n / size).cast<float>();
            mesh.face_normal.span().set(t, {unit.x(), unit.y(), unit.z()});
        }
    }
}

/// How many edges do not lie between two triangles that agree on what is outside. Vertices at one place count
/// as one.
std::size_t count_open_edges(const Mesh& mesh) {
    const std::vector<std::uint32_t> place = welded(mesh.position.span(), mesh.vertex_count());
    // Each edge once a triangle, with +1 or -1 for its direction: the sum over a closed surface is zero.
    std::vector<std::pair<std::uint64_t, int>> edges;
    edges.reserve(mesh.corners.size());
    for (std::size_t corner = 0; corner < mesh.corners.size(); ++corner) {
        const std::size_t next = corner % 3 == 2 ? corner - 2 : corner + 1;
        const std::uint64_t a = place[mesh.corners[corner]];
        const std::uint64_t b = place[mesh.corners[next]];
        if (a != b) edges.emplace_back(std::min(a, b) << 32 | std::max(a, b), a < b ? 1 : -1);
    }
    std::ranges::sort(edges);
    std::size_t open = 0;
    for (std::size_t i = 0; i < edges.size();) {
        int balance = 0;
        const std::uint64_t edge = edges[i].first;
        for (; i < edges.size() && edges[i].first == edge; ++i) balance += edges[i].second;
        if (balance != 0) ++open;
    }
    return open;
}

void make_vertex_normals(PlacedShape& placed, const ShadingModel& shading) {
    Mesh& mesh = placed.mesh;
    std::vector<std::uint32_t>& group = placed.smooth_group;
    if (group.empty()) {
        group.resize(mesh.vertex_count());
        std::iota(group.begin(), group.end(), 0u);
    }
    Vec3Arrays normal;
    constexpr std::size_t k_guard = 16;
    constexpr float k_mark = -1.2345e30f;
    normal.resize(mesh.vertex_count() + k_guard);
    for (std::size_t i = 0; i < k_guard; ++i)
        normal.span().set(mesh.vertex_count() + i, {k_mark, k_mark, k_mark});
    const MeshView view{.position = std::as_const(mesh.position).span(),
                        .corners = mesh.corners,
                        .face_normal = std::as_const(mesh.face_normal).span(),
                        .smooth_group = group,
                        .vertex_count = mesh.vertex_count(),
                        .group_count = mesh.vertex_count(),
                        .authored_normal = placed.authored_normal.empty()
                                               ? ConstVec3Span{}
                                               : std::as_const(placed.authored_normal).span()};
    shading.vertex_normals(view, normal.span());
    for (std::size_t i = 0; i < k_guard; ++i) {
        if (normal.span()[mesh.vertex_count() + i] != Vec3{k_mark, k_mark, k_mark})
            throw std::invalid_argument("it writes more vertex normals than there are vertices");
    }
    mesh.vertex_normal.resize(mesh.vertex_count());
    for (std::size_t i = 0; i < mesh.vertex_count(); ++i) {
        const Vec3 n = std::as_const(normal).span()[group[i]];
        if (!std::isfinite(n.x + n.y + n.z))
            throw std::invalid_argument(
                fmt::format("the normal that it gives vertex {} is no finite number", i));
        mesh.vertex_normal.span().set(i, n);
    }
}

}  // namespace

PlacedShape place(const Shape& shape, const MeshRequest& request, const Placement& placement) {
    Collector collected;
    shape.tessellate(request, collected);
    check(collected);

    Mesh mesh = std::move(collected.mesh);
    const Eigen::Matrix3f linear = linear_part(placement);
    transform(mesh.position, linear, {placement.position.x, placement.position.y, placement.position.z});
    transform(mesh.dpdu, linear, Eigen::Vector3f::Zero());
    transform(mesh.dpdv, linear, Eigen::Vector3f::Zero());
    check_finite(mesh);
    if (!collected.authored_normal.empty()) {
        transform(collected.authored_normal, linear.inverse().transpose(), Eigen::Vector3f::Zero());
        normalize(collected.authored_normal);
    }
    if (collected.closedness == Closedness::closed) {
        mesh.closed = true;
    } else {
        mesh.open_edges = count_open_edges(mesh);
        mesh.closed = mesh.open_edges == 0;
    }
    return {std::move(mesh), std::move(collected.authored_normal), std::move(collected.smooth_group)};
}

Mesh with_normals(PlacedShape placed, const ShadingModel& shading) {
    make_face_normals(placed.mesh);
    make_vertex_normals(placed, shading);
    return std::move(placed.mesh);
}

Mesh build_mesh(const Shape& shape, const MeshRequest& request, const Placement& placement,
                const ShadingModel& shading) {
    return with_normals(place(shape, request, placement), shading);
}

}  // namespace candela
