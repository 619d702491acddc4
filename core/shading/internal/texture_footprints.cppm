module;

#include <array>
#include <cstddef>
#include <cstdint>

module candela.shading:texture_footprints;

import :texture;
import candela.raster;
import candela.scene;

namespace candela {

/// The position of points in one of the levels: the texel to the upper left, the offset to its neighbours,
/// and the weights of all four, two per number, the upper ones in its lower half.
struct TexelFootprints {
    alignas(64) std::array<std::int32_t, k_batch_size> texel, right, below, left_weights, right_weights;
};

/// Points in the picture: their positions, from 0 at its upper left corner to 1 at its lower right; the finer
/// of the two levels between which each lies, and the weight of the coarser one.
struct PicturePoints {
    alignas(64) std::array<float, k_batch_size> u, v;
    alignas(64) std::array<std::int32_t, k_batch_size> finer, coarser_weight;
};

/// Where points lie among the texels of all pictures of one size: found once, however many are read.
struct TextureFootprints {
    std::size_t count = 0;
    int width = 0, height = 0;  // of the pictures
    PicturePoints points;
    TexelFootprints finer, coarser;
    bool is_between_levels = false;  // some point; otherwise `coarser` is not filled
    bool is_interior = false;        // all are in the same two levels, and in the interior of both
    std::size_t level = 0;           // if they are, the finer one

    /// At most k_batch_size points.
    void find(const MipMap& picture, const std::array<TextureWrap, 2>& wraps, std::size_t count,
              const TextureCoordinates& at);

    bool fit(const MipMap& picture) const { return picture.width() == width && picture.height() == height; }
};

}  // namespace candela
