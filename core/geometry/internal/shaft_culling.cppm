// Shaft culling (Haines and Wallace 1991, "Shaft culling for efficient ray-traced radiosity"): whether light
// may be blocked on its way to a region of a surface, without a ray.
module;

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

module candela.geometry:shaft_culling;

import :mesh;
import candela.api;

namespace candela {

/// Enlarged by more than rounding may move a ray or a triangle, so that Embree finds no hit outside.
Box enlarged(const Box& box);

/// The space between points in a box and a light: a box that moves and grows. Its corners are `start`'s, plus
/// s times `low_by` and `high_by`, for s from 0 to `end`.
struct Shaft {
    Box start;
    Vec3 low_by, high_by;
    float end = 1;
    Box towards;             // the directions of the rays, not normalized
    float most_towards = 0;  // at least the length of any of these
    float reach = 0;         // at least the length of the rays' parts that may meet anything
};

Shaft shaft_to(const Box& start, const Box& light);
/// To a distant light. All surfaces are in the box `scene`.
Shaft shaft_towards(const Box& start, Vec3 direction, const Box& scene);

/// Clusters of a mesh's triangles that are close to each other, with the boxes around their positions and
/// around their normals, in a tree of sixteen children per node.
class TriangleClusters {
  public:
    /// `is_one_way`: triangles block only light that would enter through their front.
    TriangleClusters(const Mesh& mesh, bool is_one_way);

    /// Whether a triangle may block light in the shaft; `false` is certain.
    bool may_block(const Shaft& shaft) const;

    static constexpr std::size_t k_width = 16;

    /// Sixteen clusters, or groups of them.
    struct alignas(64) Node {
        using Lanes = std::array<float, k_width>;
        std::array<Lanes, 3> high, minus_low;  // of positions
        std::array<Lanes, 3> least_normal, most_normal;
        Lanes inverse_height;  // at least one over the smallest height of a triangle
    };

  private:
    std::vector<Node> nodes_;
    std::vector<std::uint32_t> first_;  // node of each level; clusters are in level 0, the root in the last
};

}  // namespace candela
