module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

export module candela.geometry:triangle_tree;

import candela.api;

export namespace candela {

/// The points where rays leave a surface: one element per ray.
struct RayExits {
    std::uint32_t* triangle = nullptr;
    float* distance =
        nullptr;  // along the ray, in multiples of its direction; negative if the ray does not leave
    Vec3Span barycentric;
};

/// Triangles, for rays that run inside their surface. Immutable; any thread.
class CANDELA_EXPORT TriangleTree {
  public:
    /// Triangles are counter-clockwise seen from outside.
    TriangleTree(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> indices);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    /// Finds, for each ray, the nearest triangle that it crosses from inside to outside. A triangle on which
    /// it starts, heading inwards, does not count. If the surface is open there, the ray has no exit, and
    /// only the distance is written. A ray's exit does not depend on the others; rays that stay close to each
    /// other are fast. Arrays do not alias.
    void find_exits(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                    const RayExits& exits) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace candela
