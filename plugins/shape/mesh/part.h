// A part of a surface: the triangles of one material.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "mesh_io/surface.h"

namespace mesh {

/// A surface's triangles, sorted by material, so that each of a hundred parts costs no more than itself.
class TrianglesByMaterial {
  public:
    explicit TrianglesByMaterial(const mesh_io::Surface& surface);

    /// In ascending order; empty for a material that no triangle has.
    std::span<const std::uint32_t> of(std::size_t material) const {
        return std::span(triangles_).subspan(begin_[material], begin_[material + 1] - begin_[material]);
    }

  private:
    std::vector<std::uint32_t> begin_{};  // per material, and the end
    mesh_io::Array<std::uint32_t> triangles_;
};

/// The triangles whose material has that name or number ("#0"), with the vertices that they use. Throws
/// BadFile listing the materials if there are none.
mesh_io::Surface part_of(const mesh_io::Surface& surface, const TrianglesByMaterial& triangles,
                         std::string_view part);

}  // namespace mesh
