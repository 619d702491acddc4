// Pictures that multiply the colour of a surface, by its texture coordinates.
module;

#include "candela/plugin/export.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <span>
#include <vector>

export module candela.shading:texture;

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

export namespace candela {

/// Texture coordinates of points, and how they change from pixel to pixel: zero if light is evaluated for a
/// face or a vertex instead of a pixel.
struct TextureCoordinates {
    ConstVec2Span uv;     // v grows upwards; the picture spans 0 to 1
    ConstVec2Span per_x;  // their derivatives per pixel to the right
    ConstVec2Span per_y;  // and per pixel downwards
};

/// A picture and its mip levels, each half as wide and high as the one before, down to a single texel
/// (Williams 1983, "Pyramidal parametrics"). Texels are intensities, linear if the scene's are. Immutable;
/// any thread.
class CANDELA_EXPORT MipMap {
  public:
    struct Level {
        int width = 0;
        int height = 0;
        std::size_t first = 0;  // texel
    };
    /// Four channels per texel: red, green, blue, 65535 for an intensity of 1; the fourth is padding.
    using Texels = AlignedVector<std::uint16_t>;

    /// `texels` are those of the picture, rows from the top; their number is `width` x `height`, less than
    /// 2^31. Levels are made with the threads that with_threads() allows.
    MipMap(int width, int height, Texels texels);

    int width() const noexcept { return levels_.front().width; }
    int height() const noexcept { return levels_.front().height; }
    std::span<const Level> levels() const noexcept { return levels_; }
    /// All levels, one after the other.
    std::span<const std::uint16_t> texels() const noexcept { return texels_; }

    /// Multiplies `color` at each of `count` points by the value of the picture: bilinear within a level,
    /// linear between the two levels whose texels are closest in size to a pixel (of an elongated footprint,
    /// to its longer side).
    void multiply(TextureWrap wrap, std::size_t count, const TextureCoordinates& at,
                  const Vec3Span& color) const noexcept;

  private:
    Texels texels_;
    std::vector<Level> levels_;
    AlignedVector<std::int32_t> sizes_;  // of each level: width, height, first texel, padding
};

/// A picture from a file.
struct TextureImage {
    std::shared_ptr<const MipMap> mip_map;
    bool was_clamped = false;  // it has intensities above 1, which no surface colour has
};

/// Reads a picture and makes its levels; 8-bit colours are decoded according to `encoding`. Throws Error if
/// no image plugin supports the format, the file is unreadable, or memory is short.
CANDELA_EXPORT TextureImage read_texture(const std::filesystem::path& file, Registry& registry,
                                         ColorEncoding encoding);

}  // namespace candela
