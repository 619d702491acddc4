module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

export module candela.geometry:containment;

import candela.api;

export namespace candela {

/// An axis-aligned box; low > high if it is empty.
struct Box {
    Vec3 low;
    Vec3 high;

    constexpr Vec3 size() const { return high - low; }
    constexpr bool contains(Vec3 p) const {
        return p.x >= low.x && p.x <= high.x && p.y >= low.y && p.y <= high.y && p.z >= low.z &&
               p.z <= high.z;
    }
};

/// The box around two.
constexpr Box united(const Box& a, const Box& b) {
    const auto least = [](float p, float q) { return p < q ? p : q; };
    const auto most = [](float p, float q) { return p > q ? p : q; };
    return {{least(a.low.x, b.low.x), least(a.low.y, b.low.y), least(a.low.z, b.low.z)},
            {most(a.high.x, b.high.x), most(a.high.y, b.high.y), most(a.high.z, b.high.z)}};
}

CANDELA_EXPORT Box box_around(ConstVec3Span position, std::size_t count);

/// Whether other bodies may be inside this one.
enum class Solidity : bool { solid, hollow };

/// The space enclosed by a surface of triangles. Immutable; any thread.
///
/// Touching bodies do not overlap, and floats round, so the surface is shrunk by a hundred-thousandth of the
/// body's size (less for thin ones) before any query, except that of a hollow body for overlap with a solid
/// one, which may touch it from either side.
class CANDELA_EXPORT Body {
  public:
    /// Triangles are counter-clockwise seen from outside; a closed surface with the opposite orientation is
    /// detected. `closed`: each edge is shared by two triangles.
    Body(ConstVec3Span position, std::size_t vertex_count, std::span<const std::uint32_t> indices,
         bool closed, Solidity solidity = Solidity::solid);
    Body(Body&&) noexcept;
    Body& operator=(Body&&) noexcept;
    ~Body();

    /// Whether `point` is inside: the winding number is not zero or, for an open surface, more than half of
    /// the full solid angle shows the surface's inside (Jacobson, Kavan, Sorkine-Hornung 2013, "Robust
    /// inside-outside segmentation using generalized winding numbers", section 3).
    bool contains(Vec3 point) const;

    friend CANDELA_EXPORT bool overlap(const Body& a, const Body& b);

  private:
    struct Surface;
    std::unique_ptr<Surface> surface_;
};

/// Whether two bodies overlap: their surfaces cross, or one is at least partly inside the other, which is not
/// hollow.
CANDELA_EXPORT bool overlap(const Body& a, const Body& b);

/// Finds which of many boxes intersect.
class CANDELA_EXPORT BoxTree {
  public:
    explicit BoxTree(std::vector<Box> boxes);
    BoxTree(BoxTree&&) noexcept;
    BoxTree& operator=(BoxTree&&) noexcept;
    ~BoxTree();

    /// The boxes that contain `point`, in ascending order.
    std::vector<std::size_t> at(Vec3 point) const;
    /// The boxes, other than `box` itself, that overlap it, in ascending order; touching does not count.
    std::vector<std::size_t> meeting(std::size_t box) const;

  private:
    struct Tree;
    std::unique_ptr<Tree> tree_;
};

}  // namespace candela
