// The connected parts of a mesh.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "corners.h"
#include "mesh_io/surface.h"

namespace mesh {

/// The sets of places that triangles connect.
class ConnectedComponents {
  public:
    ConnectedComponents(const mesh_io::Surface& surface, const Corners& corners);

    std::size_t count() const { return count_; }
    /// From 0, in the order of their first places.
    std::uint32_t of_place(std::uint32_t place) const { return part_[place]; }

  private:
    mesh_io::Array<std::uint32_t> part_;  // per place
    std::size_t count_ = 0;
};

/// For each part, the parts that contain it, found by following a ray from one of its places.
/// ConnectedComponents that are not `closed` contain nothing.
std::vector<std::vector<std::uint32_t>> containers_of(const mesh_io::Surface& surface, const Corners& corners,
                                                      const ConnectedComponents& parts,
                                                      const std::vector<bool>& closed);

}  // namespace mesh
