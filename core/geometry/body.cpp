module;

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <mutex>
#include <numbers>
#include <numeric>
#include <optional>
#include <span>
#include <unsupported/Eigen/BVH>
#include <utility>
#include <vector>

module candela.geometry;

import :oriented_box;
import candela.api;

namespace candela {

namespace {

using Eigen::Vector3d;
using AlignedBox = Eigen::AlignedBox3d;
using Triangle = std::array<Vector3d, 3>;

Vector3d vector(Vec3 p) { return {p.x, p.y, p.z}; }

double triple_product(const Vector3d& a, const Vector3d& b, const Vector3d& c) { return a.dot(b.cross(c)); }

/// Union-find over the connected parts that vertices belong to: union by size, path halving.
class ConnectedComponents {
  public:
    explicit ConnectedComponents(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }

    std::uint32_t of(std::uint32_t i) {
        while (parent_[i] != i) i = parent_[i] = parent_[parent_[i]];
        return i;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = of(a);
        b = of(b);
        parent_[std::max(a, b)] = std::min(a, b);
    }

  private:
    std::vector<std::uint32_t> parent_;
};

/// Whether the segment p q passes through the triangle.
bool pierces(const Vector3d& p, const Vector3d& q, const Triangle& t) {
    const Vector3d a = t[0] - p, b = t[1] - p, c = t[2] - p, d = q - p;
    const double u = triple_product(d, c, b), v = triple_product(d, a, c), w = triple_product(d, b, a);
    if (!((u > 0 && v > 0 && w > 0) || (u < 0 && v < 0 && w < 0))) return false;
    const Vector3d normal = (t[1] - t[0]).cross(t[2] - t[0]);
    return (normal.dot(a) > 0) != (normal.dot(t[0] - q) > 0);
}

/// The positions that triangles refer to, some of them several times.
std::vector<Double3> used(const std::vector<Vector3d>& position,
                          const std::vector<std::array<std::uint32_t, 3>>& triangles) {
    std::vector<Double3> result;
    result.reserve(3 * triangles.size());
    for (const auto& triangle : triangles) {
        for (const std::uint32_t vertex : triangle)
            result.push_back({position[vertex].x(), position[vertex].y(), position[vertex].z()});
    }
    return result;
}

bool they_cross(const Triangle& s, const Triangle& t) {
    for (std::size_t k = 0; k < 3; ++k) {
        if (pierces(s[k], s[(k + 1) % 3], t) || pierces(t[k], t[(k + 1) % 3], s)) return true;
    }
    return false;
}

}  // namespace

struct Body::Surface {
    std::vector<Vector3d> position;  // shrunk
    std::vector<std::array<std::uint32_t, 3>> triangles;
    std::vector<std::uint32_t> parts;  // one vertex of each connected part
    AlignedBox box;
    OrientedBox oriented;
    double margin = 0;  // by which the surface was shrunk
    bool closed = false;
    Solidity solidity = Solidity::solid;

    Triangle triangle(std::uint32_t i) const {
        const auto& [a, b, c] = triangles[i];
        return {position[a], position[b], position[c]};
    }
    AlignedBox box_of(std::uint32_t i) const {
        AlignedBox result;
        for (const Vector3d& p : triangle(i)) result.extend(p);
        return result;
    }

    std::vector<Vector3d> unmoved;  // the positions before, of a hollow body

    using Tree = Eigen::KdBVH<double, 3, std::uint32_t>;

    /// A hollow body with its surface where it was: solid bodies may touch it on both sides. Made on demand.
    /// Any thread.
    const Surface& at_rest() const;
    void enclose();
    /// The tree of the triangles. Made on demand, because boxes separate most bodies. Any thread.
    const Tree& tree() const;
    void draw_inwards();
    double signed_volume() const;
    std::optional<int> crossings(const Vector3d& point, const Vector3d& direction) const;
    double solid_angle(const Vector3d& point) const;
    bool contains(const Vector3d& point) const;

  private:
    mutable std::once_flag has_tree_, has_at_rest_;
    mutable Tree tree_;
    mutable std::unique_ptr<Surface> at_rest_;
};

/// Finds the boxes.
void Body::Surface::enclose() {
    box.setEmpty();
    for (std::uint32_t i = 0; i < triangles.size(); ++i) box.extend(box_of(i));
    oriented = oriented_box(used(position, triangles));
}

const Body::Surface& Body::Surface::at_rest() const {
    std::call_once(has_at_rest_, [this] {
        at_rest_ = std::make_unique<Surface>();
        at_rest_->position = unmoved;
        at_rest_->triangles = triangles;
        at_rest_->parts = parts;
        at_rest_->margin = margin;
        at_rest_->closed = closed;
        at_rest_->solidity = solidity;
        at_rest_->enclose();
    });
    return *at_rest_;
}

const Body::Surface::Tree& Body::Surface::tree() const {
    std::call_once(has_tree_, [this] {
        std::vector<std::uint32_t> numbers(triangles.size());
        std::iota(numbers.begin(), numbers.end(), 0u);
        std::vector<AlignedBox> boxes(triangles.size());
        std::ranges::transform(numbers, boxes.begin(), [this](std::uint32_t i) { return box_of(i); });
        tree_.init(numbers.begin(), numbers.end(), boxes.begin(), boxes.end());
    });
    return tree_;
}

double Body::Surface::signed_volume() const {
    const Vector3d centre = box.center();
    double six_volumes = 0;
    for (const auto& [a, b, c] : triangles) {
        six_volumes += triple_product(position[a] - centre, position[b] - centre, position[c] - centre);
    }
    return six_volumes / 6;
}

/// Moves each vertex against the normals around it, far enough to move the faces by `margin`.
void Body::Surface::draw_inwards() {
    constexpr double k_touching = 1e-5;  // of the size
    constexpr double k_rounding = 3e-7;  // of the coordinates, as floats
    const double thinnest = box.sizes().minCoeff();
    const double coarseness =
        k_rounding * std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
    margin = std::max(std::min(k_touching * box.diagonal().norm(), 0.05 * thinnest), coarseness);

    const double outwards = closed && signed_volume() < 0 ? -1 : 1;
    std::vector<Vector3d> face(triangles.size(), Vector3d::Zero());
    std::vector<Vector3d> around(position.size(), Vector3d::Zero());
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        const Triangle t = triangle(static_cast<std::uint32_t>(i));
        face[i] = outwards * (t[1] - t[0]).cross(t[2] - t[0]).stableNormalized();
        for (std::size_t k = 0; k < 3; ++k) {
            const Vector3d p = t[(k + 1) % 3] - t[k];
            const Vector3d q = t[(k + 2) % 3] - t[k];
            // With angle weights, the sum does not depend on how a face is triangulated (Thürmer, Wüthrich
            // 1998).
            around[triangles[i][k]] += std::atan2(p.cross(q).norm(), p.dot(q)) * face[i];
        }
    }
    std::vector<double> steepest(position.size(), 1);
    for (Vector3d& normal : around) normal.stableNormalize();
    for (std::size_t i = 0; i < triangles.size(); ++i) {
        for (const std::uint32_t vertex : triangles[i]) {
            if (face[i] != Vector3d::Zero())
                steepest[vertex] = std::min(steepest[vertex], around[vertex].dot(face[i]));
        }
    }
    constexpr double k_spike = 0.2;  // sharper ones would move too far
    for (std::size_t i = 0; i < position.size(); ++i)
        position[i] -= margin / std::max(steepest[i], k_spike) * around[i];
}

/// The signed number of times a ray leaves the surface; nothing if it hits an edge or starts on the surface.
std::optional<int> Body::Surface::crossings(const Vector3d& point, const Vector3d& direction) const {
    struct Ray {
        const Surface& surface;
        const Vector3d& point;
        const Vector3d& direction;
        int count = 0;
        bool undecided = false;

        bool intersectVolume(const AlignedBox& volume) const {
            double nearest = 0;
            double farthest = std::numeric_limits<double>::infinity();
            for (int axis = 0; axis < 3; ++axis) {
                const double t0 = (volume.min()[axis] - point[axis]) / direction[axis];
                const double t1 = (volume.max()[axis] - point[axis]) / direction[axis];
                nearest = std::max(nearest, std::min(t0, t1));
                farthest = std::min(farthest, std::max(t0, t1));
            }
            return nearest <= farthest * (1 + 1e-12);
        }
        bool intersectObject(std::uint32_t i) {
            const Triangle t = surface.triangle(i);
            const Vector3d a = t[0] - point, b = t[1] - point, c = t[2] - point;
            const double largest = std::max({a.squaredNorm(), b.squaredNorm(), c.squaredNorm()});
            const double doubt = 1e-12 * largest;
            const double u = triple_product(direction, c, b), v = triple_product(direction, a, c),
                         w = triple_product(direction, b, a);
            if (std::min({u, v, w}) > doubt || std::max({u, v, w}) < -doubt) {
                const double ahead = triple_product(a, b, c) / -(u + v + w);
                if (std::abs(ahead) <= 1e-12 * std::sqrt(largest)) undecided = true;
                if (ahead > 0) count += u + v + w < 0 ? 1 : -1;
            } else if (std::min({u, v, w}) >= -doubt || std::max({u, v, w}) <= doubt) {
                undecided = true;
            }
            return undecided;
        }
    };
    Ray ray{*this, point, direction};
    Eigen::BVIntersect(tree(), ray);
    return ray.undecided ? std::nullopt : std::optional(ray.count);
}

/// The solid angle of the whole surface, seen from a point: 4 pi times the winding number. Van Oosterom and
/// Strackee (1983), "The solid angle of a plane triangle", eq. 8.
double Body::Surface::solid_angle(const Vector3d& point) const {
    double sum = 0;
    for (std::uint32_t i = 0; i < triangles.size(); ++i) {
        const Triangle t = triangle(i);
        const Vector3d a = t[0] - point, b = t[1] - point, c = t[2] - point;
        const double na = a.norm(), nb = b.norm(), nc = c.norm();
        sum += 2 * std::atan2(triple_product(a, b, c),
                              na * nb * nc + a.dot(b) * nc + b.dot(c) * na + c.dot(a) * nb);
    }
    return sum;
}

bool Body::Surface::contains(const Vector3d& point) const {
    if (!box.contains(point)) return false;
    if (closed) {
        // None is along an axis or a diagonal, where edges tend to lie.
        static const std::array k_directions = {Vector3d(0.61803, 0.74314, 0.25672).normalized(),
                                                Vector3d(-0.35355, 0.81915, -0.45061).normalized(),
                                                Vector3d(0.19509, -0.63439, 0.74805).normalized(),
                                                Vector3d(-0.83147, -0.29237, 0.47240).normalized()};
        for (const Vector3d& direction : k_directions) {
            if (const auto count = crossings(point, direction)) return *count != 0;
        }
    }
    return std::abs(solid_angle(point)) > 2 * std::numbers::pi;
}

Body::Body(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> indices,
           bool closed, Solidity solidity)
    : surface_(std::make_unique<Surface>()) {
    Surface& s = *surface_;
    s.closed = closed;
    s.solidity = solidity;
    s.position.reserve(vertex_count);
    for (std::size_t i = 0; i < vertex_count; ++i) s.position.push_back(vector(position[i]));
    const std::vector<std::uint32_t> place = welded(position, vertex_count);
    ConnectedComponents parts(vertex_count);
    for (std::size_t corner = 0; corner + 2 < indices.size(); corner += 3) {
        const std::array<std::uint32_t, 3> t = {place[indices[corner]], place[indices[corner + 1]],
                                                place[indices[corner + 2]]};
        if (t[0] == t[1] || t[1] == t[2] || t[2] == t[0]) continue;
        s.triangles.push_back(t);
        for (const std::uint32_t vertex : t) s.box.extend(s.position[vertex]);
        parts.join(t[0], t[1]);
        parts.join(t[0], t[2]);
    }
    if (s.triangles.empty()) return;
    if (solidity == Solidity::hollow) s.unmoved = s.position;
    s.draw_inwards();

    std::vector<bool> seen(vertex_count);
    for (const auto& triangle : s.triangles) {
        const std::uint32_t part = parts.of(triangle[0]);
        if (!seen[part]) s.parts.push_back(part);
        seen[part] = true;
    }
    s.enclose();
}

Body::Body(Body&&) noexcept = default;
Body& Body::operator=(Body&&) noexcept = default;
Body::~Body() = default;

bool Body::contains(Vec3 point) const { return surface_->contains(vector(point)); }

bool overlap(const Body& a_body, const Body& b_body) {
    using Surface = Body::Surface;
    const Surface& a_own = *a_body.surface_;
    const Surface& b_own = *b_body.surface_;
    if (a_own.triangles.empty() || b_own.triangles.empty() || !a_own.box.intersects(b_own.box)) return false;
    const bool is_one_solid = a_own.solidity != b_own.solidity;
    const Surface& a = is_one_solid && a_own.solidity == Solidity::hollow ? a_own.at_rest() : a_own;
    const Surface& b = is_one_solid && b_own.solidity == Solidity::hollow ? b_own.at_rest() : b_own;
    // Equal bodies next to each other have planes in common. A shift far smaller than the margins, in an
    // arbitrary direction, separates them, so that only crossings of an edge with a face remain to be found.
    const Vector3d shift = 0.1 * std::min(a.margin, b.margin) * Vector3d(0.6177, 0.5371, 0.5743);
    if (!may_meet(a.oriented, b.oriented, {shift.x(), shift.y(), shift.z()})) return false;
    struct Crossing {
        const Surface& a;
        const Surface& b;
        const Vector3d& shift;
        bool found = false;

        AlignedBox shifted(AlignedBox box) const { return box.translate(shift); }
        bool intersectVolumeVolume(const AlignedBox& va, const AlignedBox& vb) const {
            return va.intersects(shifted(vb));
        }
        bool intersectVolumeObject(const AlignedBox& va, std::uint32_t ib) const {
            return va.intersects(shifted(b.box_of(ib)));
        }
        bool intersectObjectVolume(std::uint32_t ia, const AlignedBox& vb) const {
            return a.box_of(ia).intersects(shifted(vb));
        }
        bool intersectObjectObject(std::uint32_t ia, std::uint32_t ib) {
            Triangle t = b.triangle(ib);
            for (Vector3d& p : t) p += shift;
            found = they_cross(a.triangle(ia), t);
            return found;
        }
    };
    Crossing crossing{a, b, shift};
    Eigen::BVIntersect(a.tree(), b.tree(), crossing);
    if (crossing.found) return true;
    // Neither surface crosses the other, so each connected part is entirely inside or entirely outside.
    const auto holds_part = [](const Surface& body, const Surface& other, const Vector3d& moved) {
        return body.solidity == Solidity::solid && std::ranges::any_of(other.parts, [&](std::uint32_t v) {
                   return body.contains(other.position[v] + moved);
               });
    };
    return holds_part(b, a, -shift) || holds_part(a, b, shift);
}

}  // namespace candela
