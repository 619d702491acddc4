// Cuts triangles along the outline of an opacity map: leaves, fences and hair on cards.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "mesh_io/surface.h"

namespace mesh {

/// The opacity of a surface by its texture coordinates; rows from the top.
class Opacity {
  public:
    /// Reads an 8-bit binary greymap (PGM, P5). Throws BadFile.
    static Opacity read(std::string_view pgm);

    int width() const { return width_; }
    int height() const { return height_; }
    /// 0 to 1. Beyond the edges the map repeats, or continues with its edge pixels if it `clamps`.
    float at(int x, int y, bool clamps) const;
    /// Half as wide and high; pixels are averaged.
    Opacity halved() const;

  private:
    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

/// The part of a surface where the opacity, interpolated between the centres of its pixels, is at least
/// `level`. A surface without texture coordinates stays whole. If that needs too many triangles, the outline
/// is made coarser and a note is added. Throws BadFile if nothing is left.
mesh_io::Surface cut_out(const mesh_io::Surface& surface, const Opacity& opacity, float level, bool clamps);

}  // namespace mesh
