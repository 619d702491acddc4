// The interface of target plugins, which turn scenes into programs, pages and files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"
#include "candela/punctual.h"
#include "candela/shading_model.h"
#include "candela/transform.h"

namespace candela {

/// Values of a plugin's parameters, in the order of its descriptor.
struct ExportedValues {
    std::span<const ParamValue> written;  // as written in a scene: degrees, colours 0-255; a file as its path
    std::span<const ParamValue>
        runtime;  // as an instance receives them: radians, intensities, unit directions. For a parameter
                  // that is a Table of the kernel, `list` is its numbers, a part of ExportedScene::tables,
                  // and `integer` their offset in it
};

/// A plugin that the scene uses or may switch to. Its descriptor lives as long as the process and has the
/// formula, the parameters and the kernel's text.
struct ExportedModel {
    const PluginDescriptor* plugin = nullptr;
    const char* id = "";  // as commands call it: "reflection/phong", or the path of a kernel file
};

struct ExportedShading : ExportedModel {
    ShadingRate rate = ShadingRate::fragment;
    ShadingNeeds needs{};
};

struct ExportedReflection : ExportedModel {
    SurfaceNeeds needs{};             // what its kernel reads of Surface
    bool shows_surroundings = false;  // it shows the world behind and around an object
    bool is_glossy = false;  // its kernel has a function highlight_width: it mirrors ExportedLight::radiance
};

/// A light from everywhere, as seen in all directions; candela/kernel/mirror.kernel looks it up.
struct ExportedRadianceMap {
    int size = 0;       // texels per row of the finest level, a power of two; 0: there is none
    float density = 0;  // samples of the light per intensity: their number over its integral
    /// Red, green and blue of each texel, rows from the top, level after level, each half as wide and high as
    /// the one before, down to a single texel.
    std::span<const float> texels{};
};

struct ExportedLight {
    const char* label = "";  // as messages name it: 'lamp', in quotes, or number 2
    std::size_t model = 0;   // index into ExportedScene::light_models
    ExportedValues values{};
    bool is_data = false;  // whether the light describes itself as data (see extensions.h), in the next two
                           // members
    std::span<const PunctualLight> punctual{};  // one per sample
    Rgb ambient{};                              // the part that comes from everywhere
    ExportedRadianceMap radiance{};  // if it comes from everywhere, and a model of the scene is glossy
    // With ExportedScene::has_shadows:
    bool casts_shadows = true;       // objects block its samples
    int ambient_occlusion_rays = 0;  // per point, which find how much of its ambient part is blocked; or 0
    float ambient_occlusion_distance = 0;  // by what is nearer than this, metres
};

/// One level of a texture: half as wide and high as the one before, down to a single texel.
struct ExportedTextureLevel {
    int width = 0;
    int height = 0;
    std::span<const std::uint16_t> texels{};  // red, green, blue, interleaved; 65535 is an intensity of 1;
                                              // rows from the top
};

/// A picture on surfaces. Levels, and values between them, are looked up as candela.shading does.
struct ExportedTexture {
    const char* file = "";    // absolute path
    bool is_opacity = false;  // the texels' three channels are the opacity of the file's pixels
    std::span<const ExportedTextureLevel> levels{};
};

/// How a texture continues beyond its edges.
enum class ExportedWrap : int {
    repeat,
    clamp,   // the values at its edges
    mirror,  // repeated, every other time reversed
};

/// A number of a material that comes from a picture: offset + scale * texel at each point, from `minimum` to
/// `maximum`, in the units in which an instance receives it; or from a channel of the vertices instead.
struct ExportedTexturedNumber {
    static constexpr std::size_t k_none = static_cast<std::size_t>(-1);

    std::size_t parameter = 0;            // of the object's own reflection model
    std::size_t channel = 0;              // of the parameter: 0 to 2
    std::size_t texture = 0;              // index into ExportedScene::textures
    std::size_t texel_channel = 0;        // 0 to 2
    std::size_t vertex_channel = k_none;  // index into ExportedMesh::channels, instead of a texture
    ExportedWrap wrap[2] = {};            // along u and v
    int uv = 0;                           // the set of texture coordinates: 0 or 1
    /// Of texture coordinates: u' = placing[0] * u + placing[1] * v + placing[2], v' with the other three.
    float placing[6] = {1, 0, 0, 0, 1, 0};
    float scale = 1, offset = 0;
    float minimum = 0, maximum = 1;
};

/// A picture that tilts an object's normals, where light is evaluated for each fragment.
struct ExportedNormalMap {
    std::size_t texture = 0;                // index into ExportedScene::textures
    ExportedWrap wrap[2] = {};              // along u and v
    int uv = 0;                             // the set of texture coordinates: 0 or 1
    float placing[6] = {1, 0, 0, 0, 1, 0};  // of texture coordinates, as of ExportedTexturedNumber
    /// The picture has slopes of heights instead of normals: in its first two channels, where 32768 of 65535
    /// is level.
    bool has_slopes = false;
    /// The first two numbers of a normal (2 * texel - 1), or a slope's, along growing u and v: (m[0] x + m[1]
    /// y, m[2] x + m[3] y). Of slopes, in metres per unit of u and v.
    float to_uv[4] = {1, 0, 0, 1};
    /// How much of to_uv is the author's scale of normals, or height in metres.
    float scale = 1;
};

struct ExportedObject {
    const char* label = "";                       // the author's name for it, or number 2
    Vec3 color{};                                 // 0-255; white, if it has a texture
    std::size_t shading = 0;                      // its own: index into ExportedScene::shadings
    std::size_t reflection = 0;                   // its own: index into ExportedScene::reflections
    std::span<const ExportedValues> shadings{};   // values for each shading model of the scene
    std::span<const ExportedValues> materials{};  // values for each reflection model of the scene
    ExportedModel shape{};
    ExportedValues shape_values{};
    Transform transform{};
    std::span<const ExportedTexturedNumber> color_numbers{};     // three, if it has a texture, or none
    std::span<const ExportedTexturedNumber> textured_numbers{};  // of its own reflection model
    const ExportedNormalMap* normal_map = nullptr;               // or null
    // Of its material, whatever the reflection model:
    Vec3 emission{};              // 0-255; added to the light it reflects, and black if it emits nothing
    float emission_strength = 1;  // multiplies the intensities of `emission` or of its texture
    std::span<const ExportedTexturedNumber> emission_numbers{};  // three, if it has a texture, or none
    float occlusion = 1;  // multiplies what it reflects of ambient light
    std::span<const ExportedTexturedNumber> occlusion_numbers{};  // one, if it has a texture, or none
    float opacity = 1;         // the fraction of what is behind that it covers; at each sample, whatever the
                               // shading model
    float opacity_cutoff = 0;  // above 0: opaque where its opacity is at least this, absent elsewhere
    std::span<const ExportedTexturedNumber> opacity_numbers{};  // the factors of its opacity, or none
    /// Whether something may be seen through it.
    bool is_see_through() const noexcept {
        return !opacity_numbers.empty() || (opacity_cutoff > 0 ? opacity < opacity_cutoff : opacity < 1);
    }
    // With ExportedScene::has_shadows:
    bool casts_shadows = true;     // it blocks light
    bool receives_shadows = true;  // others, and its own parts, block light on it
    bool transmits_light = true;   // although it casts shadows, if its model is transparent
};

/// The position of a sample within its pixel, in pixels from the top left.
struct ExportedSample {
    float x = 0;
    float y = 0;
};

struct ExportedImage {
    int width = 0;  // pixels
    int height = 0;
    std::span<const ExportedSample> samples{};
    Vec3 background{};             // 0-255
    const char* environment = "";  // absolute path of an environment map; empty: the background
    ColorEncoding color_management = ColorEncoding::srgb;
    float exposure = 1;  // intensities are multiplied by it, but not the background
    ToneCurve tone = ToneCurve::none;
};

struct ExportedObserver {
    Vec3 position{};
    Vec3 look_at{};
    Vec3 up{};
    Projection projection = Projection::perspective;
    float fov = 0;     // perspective: full vertical angle, degrees
    float height = 0;  // orthographic: the height of the picture, metres
    // As the scene specifies them, for users who edit it: `frame_aspect` may have enlarged the values above
    // for a narrow picture.
    float unfitted_fov = 0;
    float unfitted_height = 0;
};

/// The triangles of one object. Absent arrays are null or empty.
struct ExportedMesh {
    std::size_t vertex_count = 0;
    std::span<const std::uint32_t>
        indices{};                    // three vertices per triangle, counter-clockwise seen from outside
    ConstVec3Span position{};         // metres
    ConstVec3Span authored_normal{};  // unit, from the shape; zero at a vertex without one
    std::span<const std::uint32_t> smooth_group{};  // per vertex: vertices of one group share a normal
    ConstVec2Span uv{};
    ConstVec2Span second_uv{};                           // if one of the object's textures is placed by them
    std::span<const std::span<const float>> channels{};  // numbers per vertex, for ExportedTexturedNumber
    ConstVec3Span color{};  // intensities, 0 to 1, which multiply the object's colour
    ConstVec3Span dpdu{};   // partial derivatives of position
    ConstVec3Span dpdv{};
    bool closed = false;  // otherwise visible, and lit, from both sides
    /// With shadows: closed, and nothing is inside. It blocks light only where light enters, others on both
    /// sides. (candela::OcclusionTree says how a surface meets its own light.)
    bool is_solid = false;
    // In world space only:
    std::span<const ConstVec3Span> normals{};   // sets of unit vertex normals, all different
    std::span<const std::size_t> normals_of{};  // for each shading model of the scene, the index of its set

    constexpr std::size_t triangle_count() const { return indices.size() / 3; }
};

/// Makes the triangles of a scene's objects on request. Owned by the host. One thread at a time.
class CANDELA_EXPORT ExportedGeometry {
  public:
    virtual ~ExportedGeometry();

    /// As the shape makes them, before the object's transform; with texture coordinates, and with derivatives
    /// if a model of the scene needs them. Valid until the next call. May throw.
    virtual ExportedMesh in_object_space(std::size_t object) = 0;

    /// In their place in the world, with vertex normals for each shading model; with texture coordinates, and
    /// with derivatives if a model of the scene needs them. Valid until the next call. May throw.
    virtual ExportedMesh in_world_space(std::size_t object) = 0;

    /// Whether a shading model of the scene makes the object's vertex normals by the default rule: the
    /// authored ones, otherwise the normalised sum of the adjacent faces' normals. May throw.
    virtual bool has_default_normals(std::size_t object, std::size_t shading) = 0;
};

/// A validated scene, as a target sees it. All memory belongs to the host and is valid during write().
/// Right-handed, y up, metres.
struct ExportedScene {
    const char* title = "";  // any text
    ExportedImage image{};
    ExportedObserver observer{};
    Vec3 room{};  // the size of a box around the origin that contains everything; zero: there is none
    std::span<const ExportedModel> light_models{};
    std::span<const ExportedLight> lights{};
    std::span<const ExportedShading> shadings{};        // the objects' models, then those to switch to
    std::span<const ExportedReflection> reflections{};  // in the same order
    std::span<const ExportedObject> objects{};
    std::span<const float> tables{};  // the numbers of all kernels' tables; equal tables are stored once
    std::span<const ExportedTexture> textures{};
    bool needs_uv = false;           // a model reads texture coordinates, or an object has a texture
    bool needs_derivatives = false;  // a model, or a normal map, reads partial derivatives of positions
    bool has_shadows = false;        // objects block light
    bool shadows_vary = true;        // samples of lights with an extent vary from pixel to pixel within it
    ExportedGeometry* geometry = nullptr;
};

/// Receives a target's files. Owned by the host, which writes each file whole, and none of them if write()
/// throws.
class CANDELA_EXPORT FileSink {
  public:
    virtual ~FileSink();
    /// `name` is relative to the program's folder ("shaders/lit.glsl"), without ".."; each is written once.
    /// Otherwise throws std::exception.
    virtual void write(const char* name, std::span<const std::byte> content) = 0;

    /// Declares that the files express a part of the scene only approximately, or leave it out. `sentence`,
    /// without a full stop, names that part: "reflection/ggx becomes a highlight of the same width". The host
    /// refuses the files unless the user accepts approximations; equal sentences are shown once. Does nothing
    /// unless overridden.
    virtual void approximate(const char* sentence);
};

/// The result of a program that has ended.
struct ProgramResult {
    int exit_code = 0;     // 128 + signal if a signal ended it
    const char* out = "";  // what it printed; both strings belong to the runner and are valid until its next
                           // call
    const char* err = "";
};

/// Runs programs of this machine, without a shell. Owned by the host. One thread at a time.
class CANDELA_EXPORT ProgramRunner {
  public:
    virtual ~ProgramRunner();
    /// Whether PATH has an executable of that name.
    virtual bool has(const char* program) = 0;
    /// Runs a program without input and waits for it. A name without '/' is looked up on PATH. Throws
    /// std::exception if the program cannot be started.
    virtual ProgramResult run(std::span<const char* const> words) = 0;
    /// Like run(), but inherits the user's terminal. Returns the exit code.
    virtual int show(std::span<const char* const> words) = 0;
};

/// The abilities of a target. The host refuses a scene that needs more before calling write().
struct TargetAbilities {
    bool models_without_kernel = false;  // light, shading and reflection models without a kernel: the
                                         // target's files use models of their own (shapes always export
                                         // triangles)
    bool surroundings = false;           // environment maps, and models that show what is behind an object
    bool triangle = false;               // kernels of shading models that read their triangle: ShadingNeeds
    bool vertex_colors = false;          // ExportedMesh::color; otherwise the host refuses a mesh that has it
    bool textures = false;               // ExportedObject::color_numbers
    bool textured_numbers = false;       // ExportedObject::textured_numbers
    bool second_uv = false;              // ExportedMesh::second_uv
    bool vertex_channels = false;        // ExportedTexturedNumber::vertex_channel
    bool normal_maps = false;            // ExportedObject::normal_map
    bool emission = false;               // ExportedObject::emission, and its texture
    bool occlusion = false;              // ExportedObject::occlusion, and its texture
    bool opacity = false;                // ExportedObject::opacity, its texture and cutoff
    bool shadows = false;                // ExportedScene::has_shadows
    bool display = false;                // exposure and tone of ExportedImage
};

/// Turns a scene into something else: a program, a page, a file. Any thread.
class CANDELA_EXPORT Target : public Instance {
  public:
    ~Target() override;

    virtual TargetAbilities abilities() const noexcept { return {}; }

    /// Writes all files of the scene; equal scenes yield equal files. Throws std::exception if it cannot
    /// express the scene.
    virtual void write(const ExportedScene& scene, FileSink& files) const = 0;

    /// The name of the file that users open first, one of those that write() writes.
    virtual const char* main_file() const noexcept = 0;

    /// Whether draw() is implemented; a target without it cannot be verified.
    virtual bool can_draw() const noexcept { return false; }

    /// Builds what write() wrote to `directory`, so that it is ready to run. Does nothing unless overridden.
    /// Throws std::exception with the compiler's message.
    virtual void build(const char* directory, ProgramRunner& programs) const;

    /// Makes the built program draw the scene as it is, without a display, to a PNG file of the image's size.
    /// Throws std::exception.
    virtual void draw(const char* directory, const char* picture, ProgramRunner& programs) const;

    /// Shows the built program to the user; returns an exit code. Unless overridden, the desktop opens the
    /// main file.
    virtual int show(const char* directory, ProgramRunner& programs) const;
};

}  // namespace candela
