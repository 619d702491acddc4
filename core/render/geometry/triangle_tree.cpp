module;

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <numeric>
#include <optional>
#include <span>
#include <unsupported/Eigen/BVH>
#include <vector>

module candela.geometry;

namespace candela {

namespace {

using Eigen::Vector3d;
using AlignedBox = Eigen::AlignedBox3d;

double triple_product(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return a.dot(b.cross(c)); }

}  // namespace

struct TriangleTree::Tree {
    std::vector<Vector3d> position;
    std::vector<std::array<std::uint32_t, 3>> triangles;
    Eigen::KdBVH<double, 3, std::uint32_t> tree;
    double rounding = 0;  // of a point on the surface, in float
};

TriangleTree::TriangleTree(ConstVec3Span position, std::size_t vertex_count,
                           std::span<const std::uint32_t> indices)
    : tree_(std::make_unique<Tree>()) {
    Tree& t = *tree_;
    t.position.reserve(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i)
        t.position.emplace_back(position.x[i], position.y[i], position.z[i]);
    std::vector<AlignedBox> boxes(indices.size() / 3);
    AlignedBox whole;
    for (std::size_t i = 0; i < boxes.size(); ++i) {
        t.triangles.push_back({indices[3 * i], indices[3 * i + 1], indices[3 * i + 2]});
        for (const std::uint32_t corner : t.triangles.back()) boxes[i].extend(t.position[corner]);
        whole.extend(boxes[i]);
    }
    if (boxes.empty()) return;
    t.rounding = 1e-6 * std::max(whole.min().cwiseAbs().maxCoeff(), whole.max().cwiseAbs().maxCoeff());
    std::vector<std::uint32_t> numbers(boxes.size());
    std::iota(numbers.begin(), numbers.end(), 0u);
    t.tree.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
}

TriangleTree::TriangleTree(TriangleTree&&) noexcept = default;
TriangleTree& TriangleTree::operator=(TriangleTree&&) noexcept = default;
TriangleTree::~TriangleTree() = default;

std::optional<RayExit> TriangleTree::exit_of(Vec3 origin, Vec3 direction) const {
    struct Ray {
        const Tree& tree;
        Vector3d point, direction;
        RayExit nearest{0, std::numeric_limits<float>::infinity(), {}};
        bool found = false;

        bool intersectVolume(const AlignedBox& volume) const {
            double first = -tree.rounding;
            auto last = static_cast<double>(nearest.distance);
            for (int axis = 0; axis < 3; ++axis) {
                const double t0 = (volume.min()[axis] - tree.rounding - point[axis]) / direction[axis];
                const double t1 = (volume.max()[axis] + tree.rounding - point[axis]) / direction[axis];
                first = std::max(first, std::min(t0, t1));
                last = std::min(last, std::max(t0, t1));
            }
            return first <= last;
        }
        bool intersectObject(std::uint32_t i) {
            const auto& [ia, ib, ic] = tree.triangles[i];
            const Vector3d a = tree.position[ia] - point, b = tree.position[ib] - point,
                           c = tree.position[ic] - point;
            // The volumes spanned by the ray and the edges: all of one sign if it passes between them.
            const double u = triple_product(direction, b, c), v = triple_product(direction, c, a),
                         w = triple_product(direction, a, b);
            const double sum = u + v + w;
            if (!(std::min({u, v, w}) >= 0 && sum > 0)) return false;  // missed, or it enters there
            const double distance = triple_product(a, b, c) / sum;
            if (distance < -tree.rounding || distance >= static_cast<double>(nearest.distance)) return false;
            nearest = {
                i,
                static_cast<float>(std::max(distance, 0.0)),
                {static_cast<float>(u / sum), static_cast<float>(v / sum), static_cast<float>(w / sum)}};
            found = true;
            return false;
        }
    };
    if (tree_->triangles.empty()) return std::nullopt;
    // Never zero, so that a ray along a side of a box does not yield 0 / 0.
    const auto part = [](float x) { return x == 0 ? 1e-30 : static_cast<double>(x); };
    Ray ray{
        *tree_, {origin.x, origin.y, origin.z}, {part(direction.x), part(direction.y), part(direction.z)}};
    Eigen::BVIntersect(tree_->tree, ray);
    return ray.found ? std::optional(ray.nearest) : std::nullopt;
}

}  // namespace candela
