#include "corners.h"
#include "candela/parallel.h"
#include "candela/shape.h"

#include <algorithm>
#include <atomic>
#include <mutex>
#include <numeric>

namespace mesh {

namespace {

std::uint32_t next_in_triangle(std::uint32_t corner) { return corner % 3 == 2 ? corner - 2 : corner + 1; }
mesh_io::Array<std::uint32_t> places_of(const mesh_io::Surface& surface) {
    mesh_io::Array<std::uint32_t> places(surface.position.size());
    if (surface.are_places_unique) {
        std::iota(places.begin(), places.end(), 0u);
    } else {
        std::ranges::copy(candela::welded(surface.position.span(), places.size()), places.begin());
    }
    return places;
}

std::uint32_t previous_in_triangle(std::uint32_t corner) { return corner % 3 == 0 ? corner + 2 : corner - 1; }

}  // namespace

Corners::Corners(const mesh_io::Surface& surface)
    : place_(places_of(surface)), begin_(place_.size() + 1), corners_(surface.indices.size()) {
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
    // The threads wrote them in arbitrary order.
    candela::parallel_for(place_.size(), k_per_task, [&](std::size_t first, std::size_t last) {
        for (std::size_t place = first; place < last; ++place)
            std::sort(corners_.begin() + begin_[place], corners_.begin() + begin_[place + 1]);
    });
}

OpenEdges open_edges(const mesh_io::Surface& surface, const Corners& corners) {
    OpenEdges open;
    std::mutex mutex;
    candela::parallel_for(corners.places(), k_per_task, [&](std::size_t begin, std::size_t end) {
        struct Edge {
            std::uint32_t to;
            std::int32_t direction;
        };
        std::vector<Edge> edges;
        OpenEdges some;
        for (std::size_t place = begin; place < end; ++place) {
            // Each edge is visited from the lower of its two places.
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
                if (balance == 0) continue;
                ++some.count;
                if (some.places.empty() || some.places.back() != place)
                    some.places.push_back(static_cast<std::uint32_t>(place));
            }
        }
        const std::lock_guard lock(mutex);
        open.count += some.count;
        open.places.insert(open.places.end(), some.places.begin(), some.places.end());
    });
    return open;
}

}  // namespace mesh
