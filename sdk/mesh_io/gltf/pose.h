// Places vertices by morph targets and skins, in the rest pose.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "mesh_io/gltf/accessor.h"
#include "mesh_io/gltf/affine.h"
#include "mesh_io/gltf/document.h"
#include "mesh_io/gltf/walk.h"

namespace mesh_io::gltf {

/// The morph targets and joints that move a primitive's `count` vertices. Refers to the document.
class Pose {
  public:
    /// `nodes`: from node_transformations(). Throws BadFile.
    Pose(const Document& document, const Placed& placed, std::size_t count, const std::vector<Affine>& nodes);

    /// Adds the morph targets of `attribute`, "POSITION", "NORMAL" or "TANGENT", to its first three
    /// components.
    void morph(const char* attribute, std::array<Array<double>, 3>& values) const;
    /// The transformation to the world of a vertex.
    Affine of(std::size_t vertex) const;
    /// Whether all vertices have the same transformation.
    bool is_rigid() const { return joints_.empty(); }

  private:
    const Document& document_;
    const Placed& placed_;
    std::size_t count_;
    std::vector<Affine> matrices_;                 // of the skin's joints
    std::vector<Array<double>> joints_, weights_;  // per influence
};

}  // namespace mesh_io::gltf
