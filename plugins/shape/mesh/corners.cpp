#include "corners.h"
#include "candela/parallel.h"
#include "candela/shape.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <numeric>

using candela::ConstVec3Span;
using candela::Vec3;

namespace mesh {

namespace {

constexpr std::size_t k_per_task = 16384;

std::uint32_t next_in_triangle(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
std::uint32_t previous_in_triangle(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

/// The sum of `term` over all triangles, in an order that does not depend on threads.
template <class Term>
double sum(std::size_t triangles, Term term) {
    std::vector<double> partial((triangles + k_per_task - 1) / k_per_task);
    candela::parallel_for(partial.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t block = begin; block < end; ++block)
            for (std::size_t t = block * k_per_task; t < std::min((block + 1) * k_per_task, triangles); ++t)
                partial[block] += term(t);
    });
    return std::accumulate(partial.begin(), partial.end(), 0.0);
}

/// Six times the volume of the tetrahedron between a triangle and `origin`.
double six_volumes(const Surface& surface, std::size_t triangle, Vec3 origin) {
    const ConstVec3Span position = surface.position.span();
    double p[3][3];
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 v = position[surface.indices[3 * triangle + k]];
        p[k][0] = double{v.x} - origin.x;
        p[k][1] = double{v.y} - origin.y;
        p[k][2] = double{v.z} - origin.z;
    }
    return p[0][0] * (p[1][1] * p[2][2] - p[1][2] * p[2][1]) -
           p[0][1] * (p[1][0] * p[2][2] - p[1][2] * p[2][0]) +
           p[0][2] * (p[1][0] * p[2][1] - p[1][1] * p[2][0]);
}

/// How far a triangle's normals lie on its front, weighted by its area.
double agreement(const Surface& surface, std::size_t triangle) {
    const ConstVec3Span position = surface.position.span();
    const std::uint32_t* const v = &surface.indices[3 * triangle];
    const Vec3 front = cross(position[v[1]] - position[v[0]], position[v[2]] - position[v[0]]);
    double result = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const double some = dot(front, candela::normalized(surface.normal.span()[v[k]]));
        if (std::isfinite(some)) result += some;
    }
    return result;
}

}  // namespace

Corners::Corners(const Surface& surface)
    : place_(candela::welded(surface.position.span(), surface.position.size())),
      begin_(place_.size() + 1),
      corners_(surface.indices.size()) {
    const auto each_corner = [&](auto visit) {
        candela::parallel_for(corners_.size(), k_per_task, [&](std::size_t begin, std::size_t end) {
            for (std::size_t corner = begin; corner < end; ++corner)
                visit(corner, place_[surface.indices[corner]]);
        });
    };
    std::ranges::fill(begin_, 0u);
    each_corner([&](std::size_t, std::uint32_t place) {
        std::atomic_ref(begin_[place + 1]).fetch_add(1, std::memory_order_relaxed);
    });
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    // Advances from where a place's corners begin to where they end, which is where the next one's begin.
    each_corner([&](std::size_t corner, std::uint32_t place) {
        const std::uint32_t at = std::atomic_ref(begin_[place]).fetch_add(1, std::memory_order_relaxed);
        corners_[at] = static_cast<std::uint32_t>(corner);
    });
    std::ranges::copy_backward(begin_.begin(), begin_.end() - 1, begin_.end());
    begin_[0] = 0;
    // Threads leave them in any order.
    candela::parallel_for(place_.size(), k_per_task, [&](std::size_t first, std::size_t last) {
        for (std::size_t place = first; place < last; ++place)
            std::sort(corners_.begin() + begin_[place], corners_.begin() + begin_[place + 1]);
    });
}

std::uint64_t open_edges(const Surface& surface, const Corners& corners) {
    std::atomic<std::uint64_t> open = 0;
    candela::parallel_for(corners.places(), k_per_task, [&](std::size_t begin, std::size_t end) {
        struct Edge {
            std::uint32_t to;
            std::int32_t direction;
        };
        std::vector<Edge> edges;
        std::uint64_t some = 0;
        for (std::size_t place = begin; place < end; ++place) {
            // Each edge is looked at from the lower one of its places.
            edges.clear();
            for (const std::uint32_t corner : corners.at(place)) {
                const auto at = [&](std::uint32_t c) { return corners.place(surface.indices[c]); };
                const std::uint32_t next = at(next_in_triangle(corner)),
                                    previous = at(previous_in_triangle(corner));
                if (next > place) edges.push_back({next, 1});
                if (previous > place) edges.push_back({previous, -1});
            }
            std::ranges::sort(edges, {}, &Edge::to);
            for (std::size_t i = 0; i < edges.size();) {
                const std::uint32_t to = edges[i].to;
                std::int64_t balance = 0;
                for (; i < edges.size() && edges[i].to == to; ++i) balance += edges[i].direction;
                if (balance != 0) ++some;
            }
        }
        open += some;
    });
    return open;
}

bool turn_outwards(Surface& surface) {
    if (surface.indices.empty()) return false;
    const Vec3 origin = surface.position.span()[surface.indices[0]];
    const double volume =
        sum(surface.triangles(), [&](std::size_t t) { return six_volumes(surface, t, origin); });
    if (!(volume < 0)) return false;
    const double size =
        sum(surface.triangles(), [&](std::size_t t) { return std::abs(six_volumes(surface, t, origin)); });
    // What is flat has no volume but for rounding.
    constexpr double k_rounding = 1e-6;
    if (!(volume < -k_rounding * size)) return false;
    candela::parallel_for(surface.triangles(), k_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t t = begin; t < end; ++t) {
            std::swap(surface.indices[3 * t + 1], surface.indices[3 * t + 2]);
            if (!surface.facet_normal.empty())
                surface.facet_normal.span().set(t, -surface.facet_normal.span()[t]);
        }
    });
    if (!surface.normal.empty() &&
        sum(surface.triangles(), [&](std::size_t t) { return agreement(surface, t); }) < 0)
        for (std::size_t i = 0; i < surface.normal.size(); ++i)
            surface.normal.span().set(i, -surface.normal.span()[i]);
    surface.notes.emplace_back("is closed but wound inside out, so its triangles are turned round");
    return true;
}

}  // namespace mesh
