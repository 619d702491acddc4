// Inside, outside, and bodies that share space.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

export module candela.geometry;

import candela.math;

export namespace candela {

/// An axis-aligned box; low > high where it is empty.
struct Box {
    Vec3 low;
    Vec3 high;

    constexpr Vec3 size() const { return high - low; }
    constexpr bool contains(Vec3 p) const {
        return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
               p.z <= high.z;
    }
};

CANDELA_API Box box_around(ConstVec3Span position, std::size_t count);

/// For each vertex the first one at the same position, to the last bit (-0 is 0).
CANDELA_API std::vector<std::uint32_t> welded(ConstVec3Span position, std::size_t count);

/// The space that a surface of triangles encloses. Immutable; any thread.
///
/// Bodies that touch share no space, and floats round: so the surface is drawn inwards by a
/// hundred-thousandth of the body's size (less for thin ones) before anything is asked of it.
class CANDELA_API Body {
  public:
    /// Corners run counter-clockwise seen from outside; where a closed surface has it the other way round,
    /// that is noticed. `closed`: each edge lies between two triangles.
    Body(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> corners,
         bool closed);
    Body(Body&&) noexcept;
    Body& operator=(Body&&) noexcept;
    ~Body();

    /// Whether `point` is inside: the winding number is not zero; of a surface that is not closed, whether
    /// more than half of what is seen from the point is the surface's inside (Jacobson, Kavan,
    /// Sorkine-Hornung 2013, "Robust inside-outside segmentation using generalized winding numbers", section
    /// 3).
    bool contains(Vec3 point) const;

    /// Whether two bodies share space: their surfaces cross, or a part of one is inside the other.
    friend CANDELA_API bool overlap(const Body& a, const Body& b);

  private:
    struct Surface;
    std::unique_ptr<Surface> surface_;
};

CANDELA_API bool overlap(const Body& a, const Body& b);

/// Where a ray leaves a surface.
struct RayExit {
    std::uint32_t triangle = 0;
    float distance = 0;  // along the ray, in lengths of its direction
    Vec3 barycentric;
};

/// Triangles, for rays that run inside of them. Immutable; any thread.
class CANDELA_API TriangleTree {
  public:
    /// Corners run counter-clockwise seen from outside.
    TriangleTree(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> corners);
    TriangleTree(TriangleTree&&) noexcept;
    TriangleTree& operator=(TriangleTree&&) noexcept;
    ~TriangleTree();

    /// The nearest triangle that the ray passes from its inside to its outside. One that it starts on, going
    /// in, is none. Nothing where the surface is open there.
    std::optional<RayExit> exit_of(Vec3 origin, Vec3 direction) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

/// Which of many boxes meet.
class CANDELA_API BoxTree {
  public:
    explicit BoxTree(std::vector<Box> boxes);
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;
    ~BoxTree();

    /// The boxes that hold `point`, in ascending order.
    std::vector<std::size_t> at(Vec3 point) const;
    /// The boxes, other than `box` itself, that share space with it, in ascending order; those that only
    /// touch do not.
    std::vector<std::size_t> meeting(std::size_t box) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace candela
