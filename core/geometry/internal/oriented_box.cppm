// A box that fits a body in any orientation: long bodies next to each other overlap in their axis-aligned
// boxes only.
module;

#include <array>
#include <span>

module candela.geometry:oriented_box;

namespace candela {

using Double3 = std::array<double, 3>;

/// Aligned to the principal axes of the points that it encloses. (Plain arrays: clang 19 does not find
/// Eigen's own functions in units that also see Eigen through a partition.)
struct OrientedBox {
    Double3 centre{};
    std::array<Double3, 3> axes{};  // unit vectors
    Double3 half{};                 // extents along them
};

/// `points`: at least one.
OrientedBox oriented_box(std::span<const Double3> points);

/// Whether two boxes may have a point in common; `false` is certain. `shift` is added to `b`'s position. The
/// separating axis test of Gottschalk, Lin, Manocha (1996), "OBBTree: a hierarchical structure for rapid
/// interference detection", section 5.
bool may_meet(const OrientedBox& a, const OrientedBox& b, const Double3& shift);

}  // namespace candela
