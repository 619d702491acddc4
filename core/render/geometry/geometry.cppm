module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>

export module candela.geometry;

import candela.math;

export namespace candela {

/// Where a ray leaves a surface.
struct RayExit {
    std::uint32_t triangle = 0;
    float distance = 0;  // along the ray, in multiples of its direction
    Vec3 barycentric;
};

/// Triangles, for rays that run inside of them. Immutable; any thread.
class CANDELA_API TriangleTree {
  public:
    /// Triangles are counter-clockwise seen from outside.
    TriangleTree(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> indices);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    /// For each ray, the nearest triangle that it passes from its inside to its outside. A triangle that it
    /// starts on, going in, does not count. Nothing if the surface is open there. A ray's exit does not
    /// depend on the others; rays that stay close to each other are fast.
    void find_exits(const ConstVec3Span& origin, const ConstVec3Span& direction,
                    std::span<std::optional<RayExit>> exits) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace candela
