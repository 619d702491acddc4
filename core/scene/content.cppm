// The contents of a scene.
module;

#include "candela/plugin/export.h"

#include <array>
#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

export module candela.scene:content;

import :animation;
import candela.api;
import candela.plugins;
import candela.util;

export namespace candela {

/// An axis-aligned box centred on the origin: x within width/2, y (up) within height/2, z within depth/2.
/// Metres.
struct Room {
    float height = 10;
    float width = 10;
    float depth = 10;

    friend bool operator==(const Room&, const Room&) = default;
};

/// How overlapping objects are treated.
enum class Overlap : int {
    error,
    warn,
    allow,  // not checked
};

/// How strictly a scene as a whole is checked.
struct ConstraintSettings {
    Overlap overlap = Overlap::error;

    friend bool operator==(const ConstraintSettings&, const ConstraintSettings&) = default;
};

/// Where the samples of a light with an extent are.
enum class ShadowPattern : int {
    varied,  // different from pixel to pixel, so that a penumbra has no bands
    fixed,   // the same everywhere
};

/// Whether light is blocked by objects (CA AS3: by default it is not).
struct ShadowSettings {
    bool enabled = false;
    ShadowPattern pattern = ShadowPattern::varied;

    friend bool operator==(const ShadowSettings&, const ShadowSettings&) = default;
};

/// The exposure at which intensities are shown as they are: 1 cd/m^2 becomes 1.
inline constexpr float k_unexposed = -0.2630344f;

/// The factor of intensities for an exposure value at ISO 100: 1 / (1.2 * 2^EV), with which a surface whose
/// luminance saturates a camera's sensor becomes 1 (ISO 12232; Lagarde, de Rousiers 2014, section 5.1); 1 for
/// k_unexposed.
CANDELA_EXPORT float exposure_factor(float ev100) noexcept;

struct Observer {
    Vec3 position;
    Vec3 look_at;
    Vec3 up{0, 1, 0};
    Projection projection = Projection::perspective;
    float fov = 40;    // perspective: full vertical angle, degrees
    float height = 4;  // orthographic: height of the view, metres
    /// The aspect ratio (width to height) of the frame that every picture shows completely; 0: none, and a
    /// narrow picture crops the sides.
    float frame_aspect = 0;
    float exposure = k_unexposed;  // exposure value at ISO 100
    SourceLocation position_place{};

    /// Ignores positions in the file.
    friend inline bool operator==(const Observer& a, const Observer& b) {
        return a.position == b.position && a.look_at == b.look_at && a.up == b.up &&
               a.projection == b.projection && a.fov == b.fov && a.height == b.height &&
               a.frame_aspect == b.frame_aspect && a.exposure == b.exposure;
    }
};

/// As scenes name it: "khronos-neutral".
CANDELA_EXPORT std::string_view name_of(ToneCurve tone) noexcept;

/// The observer for a picture of that size: if it is narrower than the frame, it shows more above and below
/// instead of less at the sides.
CANDELA_EXPORT Observer fitted(Observer observer, int width, int height);

struct ImageSettings {
    int width = 512;
    int height = 512;
    int samples = 1;
    Vec3 background;            // 0-255
    std::string environment{};  // absolute path of an equirectangular environment map; empty: the background
    SourceLocation environment_place{};
    ColorEncoding color_management = ColorEncoding::srgb;
    ToneCurve tone = ToneCurve::none;

    /// Ignores positions in the file.
    friend inline bool operator==(const ImageSettings& a, const ImageSettings& b) {
        return a.width == b.width && a.height == b.height && a.samples == b.samples &&
               a.background == b.background && a.environment == b.environment &&
               a.color_management == b.color_management && a.tone == b.tone;
    }
};

/// A plugin with values for its parameters.
struct Model {
    std::string name;
    ParamSet parameters;

    friend bool operator==(const Model&, const Model&) = default;
};

/// The author's name for a light or an object, or its number.
struct Label {
    std::string name{};      // empty if it has none
    std::size_t number = 0;  // its index among the lights or objects of the scene's file

    /// As messages say it: 'lamp', in quotes, or number 2.
    CANDELA_EXPORT std::string text() const;
    friend inline bool operator==(const Label& a, const Label& b) {
        return a.name == b.name && (!a.name.empty() || a.number == b.number);
    }
};

/// How much of the ambient light of a point is blocked by what is near it.
struct AmbientOcclusion {
    int rays = 0;        // per point; 0: nothing is blocked
    float distance = 1;  // metres; what is further away does not block

    friend bool operator==(const AmbientOcclusion&, const AmbientOcclusion&) = default;
};

struct LightSource {
    Label label;
    Model model;
    bool casts_shadows = true;
    AmbientOcclusion ambient_occlusion{};  // of its ambient part
    bool is_background = false;            // seen where there is no object, instead of ImageSettings' own
    float temperature = 0;  // kelvin: its colour is multiplied by that of a black body; 0: it is not
    /// The author's text for parameters of the model whose values follow from a unit or the temperature.
    std::map<std::string, std::string> written{};
    SourceLocation place;
    SourceLocation position_place{};    // of its 'position', or of the whole light
    SourceLocation background_place{};  // of its 'background', or of the whole light

    /// Ignores positions in the file.
    friend inline bool operator==(const LightSource& a, const LightSource& b) {
        return a.label == b.label && a.model == b.model && a.casts_shadows == b.casts_shadows &&
               a.ambient_occlusion == b.ambient_occlusion && a.is_background == b.is_background &&
               a.temperature == b.temperature;
    }
};

/// How a texture continues outside its edges.
enum class TextureWrap : int {
    repeat,  // the picture again
    clamp,   // the colours at its edge
    mirror,  // the picture again, every other time reversed
};
/// The same along v, if that differs.
enum class TextureWrapV : int { same, repeat, clamp, mirror };

/// The channels of a picture that a parameter takes.
enum class TextureChannel : int {
    rgb,  // all three; a parameter with one number takes the red one
    red,
    green,
    blue,
    alpha,  // the opacity of its pixels; 1 if it has none
};

/// The meaning of the numbers in a picture.
enum class TextureEncoding : int {
    automatic,  // three channels are decoded like colours, one is linear
    linear,
    srgb,
};

/// How a picture is placed on texture coordinates: they are scaled, rotated, then moved.
struct TextureTransform {
    std::array<float, 2> scale{1, 1};
    float rotation = 0;  // degrees, counter-clockwise about (0, 0)
    std::array<float, 2> offset{0, 0};

    friend bool operator==(const TextureTransform&, const TextureTransform&) = default;
};

/// Where a picture lies on a surface.
struct TexturePlacing {
    int uv = 0;  // the set of the mesh's texture coordinates: 0 or 1
    TextureTransform transform{};
    TextureWrap wrap = TextureWrap::repeat;
    TextureWrapV wrap_v = TextureWrapV::same;

    /// Along u and v.
    inline std::array<TextureWrap, 2> wraps() const {
        const bool is_same = wrap_v == TextureWrapV::same;
        return {wrap, is_same ? wrap : static_cast<TextureWrap>(static_cast<int>(wrap_v) - 1)};
    }
    friend inline bool operator==(const TexturePlacing& a, const TexturePlacing& b) {
        return a.uv == b.uv && a.transform == b.transform && a.wraps() == b.wraps();
    }
};

/// A parameter of an object's material, or its colour, whose values come from a picture: offset + scale *
/// texel at each point, clamped to the parameter's range; or from an attribute of the mesh's vertices
/// instead of the texel.
struct ParameterTexture {
    std::string parameter{};
    std::string file{};       // absolute path
    std::string attribute{};  // its name, instead of a file
    TextureChannel channel = TextureChannel::rgb;
    Vec3 scale{1, 1, 1};
    Vec3 offset{};
    TextureEncoding encoding = TextureEncoding::automatic;
    TexturePlacing placing{};
    SourceLocation place{};

    /// Ignores positions in the file.
    friend inline bool operator==(const ParameterTexture& a, const ParameterTexture& b) {
        return a.parameter == b.parameter && a.file == b.file && a.attribute == b.attribute &&
               a.channel == b.channel && a.scale == b.scale && a.offset == b.offset &&
               a.encoding == b.encoding && a.placing == b.placing;
    }
};

/// A picture that tilts the normals with which an object is lit.
struct NormalMap {
    std::string file{};        // absolute path
    bool has_heights = false;  // above the surface, in its red channel; otherwise normals: 2 * texel - 1
                               // along the directions of growing u and v, and along the normal
    float scale = 1;           // of the normals' first two numbers; of heights: metres from black to white
    TexturePlacing placing{};
    SourceLocation place{};

    /// Ignores positions in the file.
    friend inline bool operator==(const NormalMap& a, const NormalMap& b) {
        return a.file == b.file && a.has_heights == b.has_heights && a.scale == b.scale &&
               a.placing == b.placing;
    }
};

/// Keys that every material has, whatever its reflection model.
struct CommonMaterial {
    Vec3 emission{};                           // 0-255; black: the surface emits nothing
    float emission_strength = 1;               // multiplies it
    float occlusion = 1;                       // multiplies what is reflected of ambient light
    float opacity = 1;                         // the fraction of what is behind that the surface covers
    float opacity_cutoff = 0;                  // above 0: the surface is there where its opacity is at
                                               // least this, and opaque; elsewhere it is not
    std::vector<ParameterTexture> textures{};  // of emission, occlusion and opacity

    CANDELA_EXPORT bool has_texture(std::string_view parameter) const;
    CANDELA_EXPORT bool emits() const;
    /// Whether something may be seen through the surface; it is then drawn from both sides.
    CANDELA_EXPORT bool is_see_through() const;
    friend bool operator==(const CommonMaterial&, const CommonMaterial&) = default;
};

struct Object {
    Label label;
    Model shape;
    Transform transform;
    Vec3 color{200, 200, 200};                        // 0-255; white, if a texture gives it
    std::optional<ParameterTexture> color_texture{};  // which gives it
    std::optional<NormalMap> normal_map{};
    bool encloses = false;  // others may be inside; drawn from both sides
    bool casts_shadows = true;
    bool receives_shadows = true;
    bool transmits_light = true;  // if its reflection model is transparent
    Model shading;
    Model reflection;
    std::vector<ParameterTexture> textures{};  // of the reflection model's parameters, in their order
    CommonMaterial common{};
    SourceLocation place;
    SourceLocation position_place{};  // of its 'position', or of the whole object

    /// Ignores positions in the file.
    friend inline bool operator==(const Object& a, const Object& b) {
        return a.label == b.label && a.shape == b.shape && a.transform == b.transform && a.color == b.color &&
               a.color_texture == b.color_texture && a.normal_map == b.normal_map &&
               a.encloses == b.encloses && a.casts_shadows == b.casts_shadows &&
               a.receives_shadows == b.receives_shadows && a.transmits_light == b.transmits_light &&
               a.shading == b.shading && a.reflection == b.reflection && a.textures == b.textures &&
               a.common == b.common;
    }
};

/// One frame, if it is animated. Every value has been checked; every plugin named is installed (none is
/// loaded). Constraints that depend on triangles come later: candela.geometry.
struct Scene {
    Room room;
    Observer observer;
    ImageSettings image;
    ConstraintSettings constraints;
    ShadowSettings shadows;
    std::vector<LightSource> lights;
    std::vector<Object> objects;
    std::optional<Animation> animation{};  // of which this is one frame

    friend CANDELA_EXPORT bool operator==(const Scene& a, const Scene& b);
};

/// The part of a scene that was understood, so that the rest can be checked as well.
struct SceneDraft {
    Scene scene;  // without lights and objects whose kind, shape or position is unknown
    bool has_room = true;
    bool has_observer = true;                    // its position is known
    bool is_complete = true;                     // there were no errors
    SourceLocation image_place{};                // of the setting that determines the picture's size
    std::vector<std::filesystem::path> files{};  // all files that were read, as absolute paths
};

}  // namespace candela
