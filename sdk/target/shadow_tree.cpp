#include "candela/target/shadow_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "candela/target/textures.h"

namespace candela::target {

namespace {

/// The number of triangles up to which a node is a leaf: with fewer, rays would read more boxes than
/// triangles.
constexpr std::size_t k_leaf_size = 4;
constexpr std::size_t k_bins = 16;
/// As in candela::OcclusionTree.
constexpr float k_relative_margin = 0x1p-20f;

float axis_of(Vec3 v, int axis) { return axis == 0 ? v.x : axis == 1 ? v.y : v.z; }

struct Box {
    Vec3 low{std::numeric_limits<float>::max(), std::numeric_limits<float>::max(),
             std::numeric_limits<float>::max()};
    Vec3 high = -low;

    void include(Vec3 p) {
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    void include(const Box& box) {
        include(box.low);
        include(box.high);
    }
    /// Half of the surface.
    float area() const {
        const Vec3 size = high - low;
        return size.x < 0 ? 0 : size.x * size.y + size.y * size.z + size.z * size.x;
    }
};

struct Triangle {
    Box box;
    Vec3 center{};           // of the box, times two
    std::size_t number = 0;  // among those of all objects
};

/// Where to divide a set of triangles: between two bins of equal width along an axis.
struct Split {
    int axis = 0;
    std::size_t bin = 0;  // the first of the right part
    float cost = std::numeric_limits<float>::infinity();
};

class Builder {
  public:
    explicit Builder(std::vector<Triangle> triangles) : triangles_(std::move(triangles)) {
        build(triangles_);
        const std::size_t end = nodes_.size();
        for (std::size_t i = 0; i < end; i += 2) {
            if (nodes_[i] == static_cast<std::int32_t>(end / 2)) nodes_[i] = -1;
            if (nodes_[i + 1] >= 0) nodes_[i + 1] += static_cast<std::int32_t>(8 * end);
        }
    }

    std::vector<std::int32_t> nodes() && { return std::move(nodes_); }
    std::span<const Triangle> triangles() const { return triangles_; }

  private:
    /// Appends the nodes of a part of `triangles_`, which it sorts.
    void build(std::span<Triangle> part) {
        const std::size_t node = nodes_.size();
        nodes_.insert(nodes_.end(), {0, -1});
        if (part.size() <= k_leaf_size) {
            const auto first = static_cast<std::size_t>(part.data() - triangles_.data());
            nodes_[node + 1] = static_cast<std::int32_t>(24 * first + part.size());
        } else {
            const std::size_t left = divide(part);
            std::array<std::span<Triangle>, 2> children{part.first(left), part.subspan(left)};
            // The larger child comes first: a ray is the likelier to end there.
            if (area_of(children[0]) < area_of(children[1])) std::swap(children[0], children[1]);
            for (const std::span<Triangle> child : children) build(child);
        }
        nodes_[node] = static_cast<std::int32_t>(nodes_.size() / 2);
    }

    static float area_of(std::span<const Triangle> part) {
        Box box;
        for (const Triangle& triangle : part) box.include(triangle.box);
        return box.area();
    }

    /// Reorders the triangles; returns the number of those on the left.
    static std::size_t divide(std::span<Triangle> part) {
        Box centers;
        for (const Triangle& triangle : part) centers.include(triangle.center);
        Split best;
        for (int axis = 0; axis < 3; ++axis) {
            const Split split = best_split(part, centers, axis);
            if (split.cost < best.cost) best = split;
        }
        const auto right = std::ranges::partition(
            part, [&](const Triangle& triangle) { return bin_of(triangle, centers, best.axis) < best.bin; });
        const std::size_t left = part.size() - right.size();
        // Triangles with the same centre cannot be told apart.
        return left == 0 || left == part.size() ? part.size() / 2 : left;
    }

    static std::size_t bin_of(const Triangle& triangle, const Box& centers, int axis) {
        const float low = axis_of(centers.low, axis), extent = axis_of(centers.high, axis) - low;
        if (!(extent > 0)) return 0;
        const float at = (axis_of(triangle.center, axis) - low) / extent;
        return std::min(static_cast<std::size_t>(at * float{k_bins}), k_bins - 1);
    }

    /// By the surface area heuristic: the chance that a ray meets a box grows with its surface (MacDonald and
    /// Booth 1990; Wald 2007, "On fast construction of SAH-based bounding volume hierarchies").
    static Split best_split(std::span<const Triangle> part, const Box& centers, int axis) {
        struct Bin {
            Box box;
            float count = 0;
        };
        std::array<Bin, k_bins> bins;
        for (const Triangle& triangle : part) {
            Bin& bin = bins[bin_of(triangle, centers, axis)];
            bin.box.include(triangle.box);
            ++bin.count;
        }
        std::array<float, k_bins> right_cost{};
        Bin sum;
        for (std::size_t i = k_bins; i-- > 1;) {
            sum.box.include(bins[i].box);
            sum.count += bins[i].count;
            right_cost[i] = sum.box.area() * sum.count;
        }
        Split best{.axis = axis};
        sum = {};
        for (std::size_t i = 1; i < k_bins; ++i) {
            sum.box.include(bins[i - 1].box);
            sum.count += bins[i - 1].count;
            const float cost = sum.box.area() * sum.count + right_cost[i];
            if (cost < best.cost) best = {.axis = axis, .bin = i, .cost = cost};
        }
        return best;
    }

    std::vector<Triangle> triangles_;
    std::vector<std::int32_t> nodes_;
};

/// The longest edge of a triangle along any axis, among those that start at its first vertex.
float extent_of(const std::array<Vec3, 3>& corners) {
    float largest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
        const Vec3 edge = corners[k] - corners[0];
        largest = std::max({largest, std::abs(edge.x), std::abs(edge.y), std::abs(edge.z)});
    }
    return largest;
}

}  // namespace

bool lets_light_through(const ExportedScene& scene) {
    return scene.has_shadows && std::ranges::any_of(scene.objects, [](const ExportedObject& object) {
               return object.casts_shadows && object.is_see_through();
           });
}

Vec3 middle_of(const ExportedMesh& mesh) {
    constexpr float k_far = std::numeric_limits<float>::max();
    Vec3 low{k_far, k_far, k_far}, high{-k_far, -k_far, -k_far};
    for (std::size_t i = 0; i < mesh.vertex_count; ++i) {
        const Vec3 p = mesh.position[i];
        low = {std::min(low.x, p.x), std::min(low.y, p.y), std::min(low.z, p.z)};
        high = {std::max(high.x, p.x), std::max(high.y, p.y), std::max(high.z, p.z)};
    }
    return 0.5f * (low + high);
}

bool has_textured_shadow(const ExportedScene& scene, const ExportedObject& object) {
    return scene.has_shadows && object.casts_shadows && !object.opacity_numbers.empty();
}

bool has_shadow_pictures(const ExportedScene& scene) {
    return std::ranges::any_of(scene.objects, [&](const ExportedObject& object) {
        return has_textured_shadow(scene, object) && !is_of_vertices(object.opacity_numbers.front());
    });
}

bool has_textured_shadows(const ExportedScene& scene) {
    return std::ranges::any_of(
        scene.objects, [&](const ExportedObject& object) { return has_textured_shadow(scene, object); });
}

ShadowTree shadow_tree(const ExportedScene& scene) {
    std::vector<Triangle> triangles;
    std::size_t all = 0;
    float largest = 0;
    for (std::size_t object = 0; object < scene.objects.size(); ++object) {
        const ExportedMesh mesh = scene.geometry->in_world_space(object);
        const bool blocks = scene.objects[object].casts_shadows;
        for (std::size_t i = 0; blocks && i < mesh.indices.size(); i += 3) {
            const std::array corners{mesh.position[mesh.indices[i]], mesh.position[mesh.indices[i + 1]],
                                     mesh.position[mesh.indices[i + 2]]};
            Triangle& triangle = triangles.emplace_back();
            triangle.number = all + i / 3;
            for (const Vec3 corner : corners) triangle.box.include(corner);
            triangle.center = triangle.box.low + triangle.box.high;
            if (!mesh.is_solid) largest = std::max(largest, extent_of(corners));
        }
        all += mesh.triangle_count();
    }
    ShadowTree tree{.nodes = {},
                    .places = std::vector<std::int32_t>(std::max<std::size_t>(all, 1), -1),
                    .least_margin = k_relative_margin * largest,
                    .triangle_count = triangles.size()};
    Builder builder(std::move(triangles));
    std::int32_t place = 0;
    for (const Triangle& triangle : builder.triangles()) tree.places[triangle.number] = place++;
    tree.nodes = std::move(builder).nodes();
    return tree;
}

}  // namespace candela::target
