#include "mesh_io/polygons.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

using candela::ConstVec3Span;
using candela::Vec3;

namespace mesh_io {

namespace {

struct Point {
    double x = 0, y = 0;
};

/// Twice the signed area; positive if counter-clockwise.
double area(Point a, Point b, Point c) { return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x); }

/// The polygon seen along its Newell normal, counter-clockwise; relative to its first corner.
std::vector<Point> projected(std::span<const std::uint32_t> corners, ConstVec3Span position) {
    const std::size_t n = corners.size();
    const Vec3 origin = position[corners[0]];
    struct Double3 {
        double x, y, z;
    };
    std::vector<Double3> p(n);
    for (std::size_t i = 0; i < n; ++i) {
        const Vec3 v = position[corners[i]];
        p[i] = {double{v.x} - origin.x, double{v.y} - origin.y, double{v.z} - origin.z};
    }
    Double3 normal{};
    for (std::size_t i = 0; i < n; ++i) {
        const Double3 &a = p[i], &b = p[(i + 1) % n];
        normal.x += a.y * b.z - a.z * b.y;
        normal.y += a.z * b.x - a.x * b.z;
        normal.z += a.x * b.y - a.y * b.x;
    }
    // Projected along the axis that loses least; the order of the other two preserves the orientation.
    const double x = std::abs(normal.x), y = std::abs(normal.y), z = std::abs(normal.z);
    std::vector<Point> flat(n);
    for (std::size_t i = 0; i < n; ++i) {
        if (z >= x && z >= y) {
            flat[i] = normal.z >= 0 ? Point{p[i].x, p[i].y} : Point{p[i].y, p[i].x};
        } else if (y >= x) {
            flat[i] = normal.y >= 0 ? Point{p[i].z, p[i].x} : Point{p[i].x, p[i].z};
        } else {
            flat[i] = normal.x >= 0 ? Point{p[i].y, p[i].z} : Point{p[i].z, p[i].y};
        }
    }
    return flat;
}

/// Clips ears off a polygon whose remaining corners form a ring.
class EarClipper {
  public:
    explicit EarClipper(std::vector<Point> points)
        : p_(std::move(points)), next_(p_.size()), prev_(p_.size()) {
        const std::size_t n = p_.size();
        for (std::size_t i = 0; i < n; ++i) {
            next_[i] = (i + 1) % n;
            prev_[i] = (i + n - 1) % n;
        }
        for (std::size_t i = 0; i < n; ++i)
            if (turn(i) <= 0) reflex_.push_back(i);
        // Each ear searches the reflex corners once for those to remove.
        spend(p_.size() * reflex_.size());
    }

    template <class Emit>
    void run(Emit emit) {
        std::size_t left = p_.size(), at = 0, since_ear = 0;
        while (left > 3) {
            spend(1);
            const bool stuck = since_ear > left;  // it crosses itself
            if (!stuck && !is_ear(at)) {
                at = next_[at];
                ++since_ear;
                continue;
            }
            emit(prev_[at], at, next_[at]);
            const std::size_t before = prev_[at], after = next_[at];
            next_[before] = after;
            prev_[after] = before;
            removed(at);
            --left;
            since_ear = 0;
            // Skipping a corner avoids the slivers of a fan.
            at = next_[after];
        }
        emit(prev_[at], at, next_[at]);
    }

  private:
    double turn(std::size_t i) const { return area(p_[prev_[i]], p_[i], p_[next_[i]]); }

    void removed(std::size_t i) {
        std::erase_if(reflex_, [&](std::size_t r) { return r == i || turn(r) > 0; });
    }

    bool is_ear(std::size_t i) {
        if (turn(i) <= 0) return false;
        const Point a = p_[prev_[i]], b = p_[i], c = p_[next_[i]];
        std::size_t tests = 0;
        const bool is_free = std::ranges::none_of(reflex_, [&](std::size_t r) {
            ++tests;
            if (r == prev_[i] || r == next_[i] || r == i) return false;
            const Point q = p_[r];
            // A second corner at the same place, as where a bridge joins a hole to the outline, does not
            // block an ear.
            if ((q.x == a.x && q.y == a.y) || (q.x == c.x && q.y == c.y)) return false;
            return area(a, b, q) >= 0 && area(b, c, q) >= 0 && area(c, a, q) >= 0;
        });
        spend(tests);
        return is_free;
    }

    /// Limits the tests to a few seconds' worth.
    void spend(std::size_t tests) {
        constexpr std::size_t k_most_tests = 500'000'000;
        tests_ += tests;
        if (tests_ > k_most_tests)
            throw BadFile(fmt::format("has a concave face of {} corners, which is too complex", p_.size()));
    }

    std::size_t tests_ = 0;
    std::vector<Point> p_;
    std::vector<std::size_t> next_, prev_;
    std::vector<std::size_t> reflex_;
};

bool is_convex(const std::vector<Point>& p) {
    const std::size_t n = p.size();
    int changes = 0;
    bool was_right = p[0].x > p[n - 1].x;
    for (std::size_t i = 0; i < n; ++i) {
        if (area(p[i], p[(i + 1) % n], p[(i + 2) % n]) < 0) return false;
        // A star also turns left at every corner, but goes round more than once.
        const double step = p[(i + 1) % n].x - p[i].x;
        if (step == 0) continue;
        if ((step > 0) != was_right) ++changes;
        was_right = step > 0;
    }
    return changes <= 2;
}

}  // namespace

void Polygons::end_face() {
    const std::size_t begin = ends.empty() ? 0 : ends.back();
    if (corners.size() - begin < 3) {
        ++too_small;
        corners.resize(begin);
        return;
    }
    if (corners.size() > 0xffff'fff0u) throw BadFile("has too many corners of faces");
    ends.push_back(static_cast<std::uint32_t>(corners.size()));
}

void triangulate(std::span<const std::uint32_t> corners, ConstVec3Span position,
                 Array<std::uint32_t>& indices) {
    const auto emit = [&](std::size_t a, std::size_t b, std::size_t c) {
        for (const std::size_t i : {a, b, c}) indices.push_back(corners[i]);
    };
    if (corners.size() == 3) return emit(0, 1, 2);
    std::vector<Point> flat = projected(corners, position);
    if (is_convex(flat)) {
        for (std::size_t i = 1; i + 1 < corners.size(); ++i) emit(0, i, i + 1);
        return;
    }
    EarClipper(std::move(flat)).run(emit);
}

void require_vertices(const Polygons& polygons, std::size_t vertices) {
    for (const std::uint32_t corner : polygons.corners) {
        if (corner >= vertices) {
            throw BadFile(
                fmt::format("has a face whose corner is out of range: vertex {} of {}, counted from 0",
                            corner, vertices));
        }
    }
}

void triangulate(const Polygons& polygons, std::span<const std::uint32_t> smoothing, Surface& surface) {
    require_vertices(polygons, surface.position.size());
    surface.indices.clear();
    surface.indices.reserve(3 * (polygons.corners.size() - 2 * polygons.ends.size()));
    std::uint32_t begin = 0;
    for (std::size_t face = 0; face < polygons.ends.size(); ++face) {
        const std::uint32_t end = polygons.ends[face];
        triangulate(std::span(polygons.corners).subspan(begin, end - begin), surface.position.span(),
                    surface.indices);
        if (!smoothing.empty()) surface.smoothing.resize(surface.triangles(), smoothing[face]);
        begin = end;
    }
    if (polygons.too_small > 0)
        surface.losses.emplace_back(counted(polygons.too_small, "face") + " of fewer than three corners");
}

}  // namespace mesh_io
