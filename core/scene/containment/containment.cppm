// Containment and overlap tests.
module;

#include "candela/api.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

export module candela.containment;

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

/// The space that a surface of triangles encloses. Immutable; any thread.
///
/// Bodies that touch share no space, and floats round: so the surface is drawn inwards by a
/// hundred-thousandth of the body's size (less for thin ones) before anything is asked of it.
class CANDELA_API Body {
  public:
    /// Corners run counter-clockwise seen from outside; where a closed surface has it the other way round,
    /// that is noticed. `closed`: each edge lies between two triangles.
    Body(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> indices,
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
