// Triangles cut along the outline of a picture of opacity: leaves, fences and hair on cards.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "surface.h"

namespace mesh {

/// How opaque a surface is, by its texture coordinates; rows from the top.
class Opacity {
  public:
    /// A binary greymap (PGM, P5) of 8 bits. Throws BadFile.
    static Opacity read(std::string_view pgm);

    int width() const { return width_; }
    int height() const { return height_; }
    /// 0 to 1; repeats, or goes on as at the edge.
    float at(int x, int y, bool clamps) const;
    /// Half as wide and high, by means.
    Opacity halved() const;

  private:
    int width_ = 0, height_ = 0;
    std::vector<float> values_;
};

/// What is left of a surface where the opacity, interpolated between the centres of its pixels, is at least
/// `level`. A surface without texture coordinates stays whole. Where it would become too many triangles, the
/// outline is coarser, with a note. Throws BadFile if nothing is left.
Surface cut_out(const Surface& surface, const Opacity& opacity, float level, bool clamps);

}  // namespace mesh
