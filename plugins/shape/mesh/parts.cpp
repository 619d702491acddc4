#include "parts.h"
#include "candela/parallel.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <numeric>

using candela::Vec3;

namespace mesh {

namespace {

/// Sets of numbers that many threads join. The root of a set is its least number, whatever the order of the
/// joins.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : parent_(count) {
        std::iota(parent_.begin(), parent_.end(), 0u);
    }
    std::uint32_t root(std::uint32_t i) {
        for (;;) {
            const std::uint32_t up = load(i);
            if (up == i) return i;
            const std::uint32_t above = load(up);
            std::uint32_t expected = up;
            if (above != up) at(i).compare_exchange_weak(expected, above, std::memory_order_relaxed);
            i = above;
        }
    }
    void join(std::uint32_t a, std::uint32_t b) {
        for (;;) {
            a = root(a);
            b = root(b);
            if (a == b) return;
            if (a < b) std::swap(a, b);
            std::uint32_t expected = a;
            if (at(a).compare_exchange_strong(expected, b, std::memory_order_relaxed)) return;
        }
    }

  private:
    std::atomic_ref<std::uint32_t> at(std::uint32_t i) { return std::atomic_ref(parent_[i]); }
    std::uint32_t load(std::uint32_t i) { return at(i).load(std::memory_order_relaxed); }

    mesh_io::Array<std::uint32_t> parent_;
};

struct Point2 {
    double y, z;
};

/// Twice the signed area of (a, b, p); exactly the negative of that for (b, a, p).
double side(Point2 a, Point2 b, Point2 p) {
    const bool swaps = b.y < a.y || (b.y == a.y && b.z < a.z);
    if (swaps) std::swap(a, b);
    const double area = (b.y - a.y) * (p.z - a.z) - (b.z - a.z) * (p.y - a.y);
    return swaps ? -area : area;
}

/// Triangles by the cells of a grid that they reach into, seen along x.
class Columns {
  public:
    Columns(const mesh_io::Surface& surface, const std::vector<std::uint32_t>& triangles)
        : surface_(surface), triangles_(triangles) {
        for (const std::uint32_t t : triangles) {
            for (std::size_t k = 0; k < 3; ++k) {
                const Point2 p = flat(corner(t, k));
                low_ = {std::min(low_.y, p.y), std::min(low_.z, p.z)};
                high_ = {std::max(high_.y, p.y), std::max(high_.z, p.z)};
            }
        }
        constexpr double k_most_cells = 1024;
        cells_ = static_cast<std::size_t>(
            std::clamp(std::sqrt(static_cast<double>(triangles.size())), 1.0, k_most_cells));
        // Long triangles reach into many cells.
        constexpr std::size_t k_copies = 8;
        while (cells_ > 1 && entries() > k_copies * triangles.size()) cells_ /= 2;
        fill();
    }

    /// Calls visit(triangle) for each triangle that a ray from `from` along x goes through.
    template <class Visit>
    void pierced(Vec3 from, Visit visit) const {
        const Point2 p = flat(from);
        if (p.y < low_.y || p.y > high_.y || p.z < low_.z || p.z > high_.z) return;
        const std::size_t cell = row(p.z) * cells_ + column(p.y);
        for (std::uint32_t i = begin_[cell]; i < begin_[cell + 1]; ++i)
            if (is_pierced(entry_[i], from)) visit(entry_[i]);
    }

  private:
    static Point2 flat(Vec3 v) { return {v.y, v.z}; }
    Vec3 corner(std::uint32_t t, std::size_t k) const {
        return surface_.position.span()[surface_.indices[3 * std::size_t{t} + k]];
    }
    std::size_t cell_at(double x, double low, double high) const {
        const double share = high > low ? (x - low) / (high - low) : 0;
        return std::min(static_cast<std::size_t>(share * static_cast<double>(cells_)), cells_ - 1);
    }
    std::size_t column(double y) const { return cell_at(y, low_.y, high_.y); }
    std::size_t row(double z) const { return cell_at(z, low_.z, high_.z); }

    struct CellRange {
        std::size_t left, right, bottom, top;
    };
    CellRange cells_of(std::uint32_t t) const {
        const Point2 a = flat(corner(t, 0)), b = flat(corner(t, 1)), c = flat(corner(t, 2));
        return {column(std::min({a.y, b.y, c.y})), column(std::max({a.y, b.y, c.y})),
                row(std::min({a.z, b.z, c.z})), row(std::max({a.z, b.z, c.z}))};
    }
    std::size_t entries() const {
        std::size_t count = 0;
        for (const std::uint32_t t : triangles_) {
            const CellRange r = cells_of(t);
            count += (r.right - r.left + 1) * (r.top - r.bottom + 1);
        }
        return count;
    }
    void fill() {
        begin_.assign(cells_ * cells_ + 1, 0);
        const auto each = [&](auto visit) {
            for (const std::uint32_t t : triangles_) {
                const CellRange r = cells_of(t);
                for (std::size_t z = r.bottom; z <= r.top; ++z)
                    for (std::size_t y = r.left; y <= r.right; ++y) visit(z * cells_ + y, t);
            }
        };
        each([&](std::size_t cell, std::uint32_t) { ++begin_[cell + 1]; });
        std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
        entry_.resize(begin_.back());
        std::vector<std::uint32_t> next(begin_.begin(), begin_.end() - 1);
        each([&](std::size_t cell, std::uint32_t t) { entry_[next[cell]++] = t; });
    }

    /// A ray through an edge goes through exactly one of the two adjacent triangles, because both make the
    /// same decision about its side of the edge.
    bool is_pierced(std::uint32_t t, Vec3 from) const {
        const Point2 p = flat(from);
        std::array<double, 3> area{};
        bool is_inside = false;
        for (std::size_t k = 0; k < 3; ++k) {
            const Point2 a = flat(corner(t, k)), b = flat(corner(t, (k + 1) % 3));
            const double s = area[(k + 2) % 3] = side(a, b, p);
            if ((a.z > p.z) != (b.z > p.z) && (b.z > a.z ? s : -s) > 0) is_inside = !is_inside;
        }
        if (!is_inside) return false;
        const double whole = area[0] + area[1] + area[2];
        if (whole == 0) return false;
        double x = 0;
        for (std::size_t k = 0; k < 3; ++k) x += area[k] / whole * corner(t, k).x;
        return x > from.x;
    }

    const mesh_io::Surface& surface_;
    const std::vector<std::uint32_t>& triangles_;
    Point2 low_{std::numeric_limits<double>::max(), std::numeric_limits<double>::max()};
    Point2 high_{std::numeric_limits<double>::lowest(), std::numeric_limits<double>::lowest()};
    std::size_t cells_ = 1;
    std::vector<std::uint32_t> begin_, entry_;
};

}  // namespace

ConnectedComponents::ConnectedComponents(const mesh_io::Surface& surface, const Corners& corners)
    : part_(corners.places()) {
    DisjointSets sets(corners.places());
    candela::parallel_for(surface.triangles(), k_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            const std::uint32_t first = corners.place(surface.indices[3 * t]);
            for (std::size_t k = 1; k < 3; ++k) sets.join(first, corners.place(surface.indices[3 * t + k]));
        }
    });
    // A root is the least of its places, so its number is known before it is needed.
    for (std::uint32_t place = 0; place < part_.size(); ++place) {
        if (corners.at(place).empty()) continue;
        const std::uint32_t root = sets.root(place);
        part_[place] = root == place ? static_cast<std::uint32_t>(count_++) : part_[root];
    }
}

std::vector<std::vector<std::uint32_t>> containers_of(const mesh_io::Surface& surface, const Corners& corners,
                                                      const ConnectedComponents& parts,
                                                      const std::vector<bool>& closed) {
    const auto part_of = [&](std::uint32_t t) {
        return parts.of_place(corners.place(surface.indices[3 * std::size_t{t}]));
    };
    std::vector<std::uint32_t> triangles, first(parts.count(), std::numeric_limits<std::uint32_t>::max());
    for (std::uint32_t t = 0; t < surface.triangles(); ++t) {
        const std::uint32_t part = part_of(t);
        first[part] = std::min(first[part], t);
        if (closed[part]) triangles.push_back(t);
    }
    const Columns columns(surface, triangles);
    std::vector<std::vector<std::uint32_t>> containers(parts.count());
    constexpr std::size_t k_some = 64;
    candela::parallel_for(parts.count(), k_some, [&](std::size_t begin, std::size_t end) {
        std::vector<std::uint32_t> left;
        for (std::size_t part = begin; part < end; ++part) {
            left.clear();
            columns.pierced(surface.position.span()[surface.indices[3 * std::size_t{first[part]}]],
                            [&](std::uint32_t t) {
                                if (part_of(t) != part) left.push_back(part_of(t));
                            });
            std::ranges::sort(left);
            for (std::size_t i = 0; i < left.size();) {
                const std::size_t before = i;
                while (i < left.size() && left[i] == left[before]) ++i;
                if ((i - before) % 2 == 1) containers[part].push_back(left[before]);
            }
        }
    });
    return containers;
}

}  // namespace mesh
