// Pictures that give the colour of a surface and the numbers of its material, by its texture coordinates.
module;

#include "candela/plugin/export.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

export module candela.shading:texture;

import candela.api;
import candela.plugins;
import candela.scene;
import candela.util;

namespace candela {
struct TextureFootprints;
}

export namespace candela {

/// Texture coordinates of points, and how they change from pixel to pixel: zero if light is evaluated for a
/// face or a vertex instead of a pixel.
struct TextureCoordinates {
    ConstVec2Span uv;     // v grows upwards; the picture spans 0 to 1
    ConstVec2Span per_x;  // their derivatives per pixel to the right
    ConstVec2Span per_y;  // and per pixel downwards
};

/// The texture coordinates and vertex channels of a batch.
struct TexturedPoints {
    std::array<TextureCoordinates, 2> uv{};            // by set
    std::span<const AlignedVector<float>> channels{};  // of the mesh, as vertex_channels_of() names them
};

/// The numbers of its mesh's vertices that an object's textures need: the second texture coordinates first,
/// if one is placed by them, then those of attributes. They refer to the object's names.
CANDELA_EXPORT std::vector<VertexChannel> vertex_channels_of(const Object& object);

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
    /// Red, green and blue, interleaved, 65535 for an intensity of 1.
    using Texels = AlignedVector<std::uint16_t>;

    /// Zeros for a picture's texels, fewer than 2^31, with memory reserved for its levels.
    static Texels room_for(int width, int height);

    /// `texels` are those of the picture, rows from the top. Levels are made with the threads that
    /// with_threads() allows.
    MipMap(int width, int height, Texels texels);

    int width() const noexcept { return levels_.front().width; }
    int height() const noexcept { return levels_.front().height; }
    std::span<const Level> levels() const noexcept { return levels_; }
    /// All levels, one after the other; behind them, k_padding numbers that may be read.
    std::span<const std::uint16_t> texels() const noexcept { return texels_; }

    /// Of each level: width, height, first texel, padding.
    std::span<const std::int32_t> sizes() const noexcept { return sizes_; }

    /// Multiplies `color` at each point by the value of the picture: bilinear within a level, linear between
    /// the two levels whose texels are closest in size to a pixel (of an elongated footprint, to its longer
    /// side). The points have been found in this picture or one of the same size.
    void multiply(const TextureFootprints& at, const Vec3Span& color) const noexcept;

    static constexpr std::size_t k_padding = 2;

  private:
    static std::vector<Level> levels_of(int width, int height);

    std::vector<Level> levels_;
    Texels texels_;
    AlignedVector<std::int32_t> sizes_;
};

/// A picture on a surface.
struct PlacedTexture {
    std::string key{};  // of the picture: its file, and how it was decoded
    std::shared_ptr<const MipMap> picture{};
    TexturePlacing placing{};

    /// Column and row, from the top left, of the picture's texel at these coordinates of its set.
    CANDELA_EXPORT std::array<int, 2> texel_at(float u, float v) const noexcept;
};

/// A number of a material that comes from a picture: offset + scale * texel, from `minimum` to `maximum`; or
/// from a channel of the vertices instead. In the units in which plugins receive it.
struct TexturedNumber {
    static constexpr std::size_t k_none = static_cast<std::size_t>(-1);

    std::size_t texture = 0;
    std::size_t texel_channel = 0;
    std::size_t vertex_channel = k_none;  // among vertex_channels_of() the object
    std::size_t parameter = 0;            // of the model, if it is one of its numbers
    std::size_t channel = 0;              // of the parameter
    float scale = 1, offset = 0;
    float minimum = 0, maximum = 1;
};

/// A picture of normals or slopes that tilts an object's normals.
struct TexturedNormal {
    std::size_t texture = 0;
    bool has_slopes = false;  // read_bump_map(); otherwise normals: 2 * texel - 1
    /// The first two numbers of a normal, or a slope's, along growing u and v: (m[0] x + m[1] y, m[2] x +
    /// m[3] y). Of slopes, in metres per unit of u and v.
    std::array<float, 4> to_uv{1, 0, 0, 1};
};

/// The parameters of a material that differ from point to point, its colour, and its normals.
struct MaterialTextures {
    static constexpr std::size_t k_none = static_cast<std::size_t>(-1);

    std::vector<PlacedTexture> textures{};
    std::vector<TexturedNumber> numbers{};
    std::size_t of_model = 0;  // how many of them, the first, are the model's
    // The first of their numbers, of three and of one:
    std::size_t color = k_none, emission = k_none, occlusion = k_none;
    std::optional<TexturedNormal> normal{};

    /// How many arrays evaluate() writes.
    std::size_t arrays() const { return numbers.size() + (normal ? 3u : 0u); }

    bool has_pictures() const { return !textures.empty(); }

    /// The picture of a parameter's texture; nothing if it cannot be used. Not called for attributes.
    using Placing = std::function<std::optional<PlacedTexture>(const ParameterTexture&, const Parameter&)>;
    /// Adds the textures of an object's material and colour to `material`, and to `opacity` that of its
    /// opacity, which is found before the others.
    CANDELA_EXPORT static void add_all(const Object& object, const Placing& place, MaterialTextures& material,
                                       MaterialTextures& opacity);

    /// Adds a picture that tilts normals, of this width and height.
    CANDELA_EXPORT void add(const NormalMap& map, const PlacedTexture& picture, int width, int height);

  private:
    std::size_t number_of(const PlacedTexture& picture);
    /// Adds the numbers of parameter `index` of the model, or of one of CommonMaterial or the colour.
    void add(const ParameterTexture& texture, const Parameter& parameter, std::size_t index,
             std::span<const VertexChannel> channels, const Placing& place);
};

/// The matrix of a transform, row by row: u' = m[0] u + m[1] v + m[2], v' with the other three.
CANDELA_EXPORT std::array<float, 6> placing_of(const TextureTransform& transform) noexcept;

/// Evaluates numbers at `count` points of a batch: value i of number k is values[k][i]. Behind them, the
/// three channels of the picture that tilts normals.
CANDELA_EXPORT void evaluate(const MaterialTextures& textures, std::size_t count, const TexturedPoints& at,
                             std::span<AlignedVector<float>> values);

/// Whether the parameter's picture is decoded like colours of the scene, or as another encoding says.
CANDELA_EXPORT ColorEncoding encoding_of(const ParameterTexture& texture, const Parameter& parameter,
                                         ColorEncoding of_scene) noexcept;

/// A picture from a file.
struct TextureImage {
    std::shared_ptr<const MipMap> mip_map;
    bool was_clamped = false;  // it has intensities above 1, which no surface colour has
};

/// Reads a picture and makes its levels; 8-bit colours are decoded according to `encoding`. Throws Error if
/// no image plugin supports the format, the file is unreadable, or memory is short.
CANDELA_EXPORT TextureImage read_texture(const std::filesystem::path& file, Registry& registry,
                                         ColorEncoding encoding);

/// The opacity of a picture's pixels, in all three channels; 1 if its format has none.
CANDELA_EXPORT TextureImage read_opacity_map(const std::filesystem::path& file, Registry& registry);

/// The slopes of a picture's heights, those of its red channel, from texel to texel: in the red and green
/// channels, along growing u and v, where k_level stands for none, and a level of 1 for an ascent by 1.
/// `wraps`: none is mirrored.
CANDELA_EXPORT TextureImage read_bump_map(const std::filesystem::path& file, Registry& registry,
                                          const std::array<TextureWrap, 2>& wraps);
inline constexpr float k_level = 32768.0f / 65535.0f;

}  // namespace candela
