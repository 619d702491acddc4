// Finds the corners of triangles that meet at one place.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "mesh_io/surface.h"

namespace mesh {

/// Triangles, corners or places that a thread takes at a time.
inline constexpr std::size_t k_per_task = 16384;

/// The corners of a surface's triangles, sorted by place. A place is a position, compared bit by bit; its
/// number is that of the first vertex there.
class Corners {
  public:
    explicit Corners(const mesh_io::Surface& surface);

    /// Per vertex.
    std::uint32_t place(std::uint32_t vertex) const { return place_[vertex]; }
    std::size_t places() const { return place_.size(); }
    /// Positions in `surface.indices`, in ascending order; empty for a vertex that is not the first at its
    /// place.
    std::span<const std::uint32_t> at(std::size_t place) const {
        return std::span(corners_).subspan(begin_[place], begin_[place + 1] - begin_[place]);
    }

  private:
    mesh_io::Array<std::uint32_t> place_;
    mesh_io::Array<std::uint32_t> begin_;
    mesh_io::Array<std::uint32_t> corners_;
};

/// Edges that are not shared by two triangles that agree on which side is outside.
struct OpenEdges {
    std::uint64_t count = 0;            // as the renderer counts them
    std::vector<std::uint32_t> places;  // one end of each, in any order
};
OpenEdges open_edges(const mesh_io::Surface& surface, const Corners& corners);

}  // namespace mesh
