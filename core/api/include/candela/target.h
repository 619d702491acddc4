// The interface of target plugins: what a scene can be turned into.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "candela/api.h"
#include "candela/descriptor.h"
#include "candela/math.h"
#include "candela/punctual.h"
#include "candela/shading.h"
#include "candela/transform.h"

namespace candela {

/// Values of a plugin's parameters, in the order of its descriptor's.
struct ExportedValues {
    std::span<const ParamValue>
        written;  // as a person writes them: degrees, colours 0-255, text of a file its path
    std::span<const ParamValue>
        delivered;  // as an instance receives them: radians, intensities, unit directions. Of a parameter
                    // that is a Table of the kernel: `list` is the table's numbers, a part of
                    // ExportedScene::tables, and `integer` where it begins there
};

/// A plugin that the scene uses, or may be switched to. Its descriptor lives as long as the process and has
/// the formula, the parameters and the kernel's text.
struct ExportedModel {
    const PluginDescriptor* plugin = nullptr;
};

struct ExportedShading : ExportedModel {
    ShadingRate rate = ShadingRate::fragment;
    ShadingNeeds needs{};
};

struct ExportedReflection : ExportedModel {
    bool needs_tangent = false;       // its kernel reads Surface::tangent
    bool needs_position = false;      // its kernel reads Surface::position
    bool needs_uv = false;            // its kernel reads Surface::uv
    bool shows_surroundings = false;  // it shows what is behind and around an object
};

struct ExportedLight {
    const char* label = "";  // as messages call it: 'lamp', in quotes, or number 2
    std::size_t model = 0;   // of ExportedScene::light_models
    ExportedValues values{};
    bool is_data = false;  // whether it can say what it sends (Light::describe()), as follows
    std::span<const PunctualLight> punctual{};  // a sample each
    Rgb ambient{};                              // the part that comes from everywhere
};

/// One of a texture's levels, each half as wide and high as the one before, down to a single texel.
struct ExportedTextureLevel {
    int width = 0;
    int height = 0;
    std::span<const std::uint16_t>
        texels{};  // red, green, blue, nothing: 65535 is an intensity of 1; rows from the top
};

/// A picture that the colours of surfaces are multiplied with. Both its levels and what lies between them are
/// looked up as candela.texture does.
struct ExportedTexture {
    const char* file = "";  // its absolute path
    std::span<const ExportedTextureLevel> levels{};
};

struct ExportedObject {
    static constexpr std::size_t k_no_texture = static_cast<std::size_t>(-1);

    const char* label = "";                       // the name that its author gave it, or number 2
    Vec3 color{};                                 // 0-255
    std::size_t shading = 0;                      // its own: of ExportedScene::shadings
    std::size_t reflection = 0;                   // its own: of ExportedScene::reflections
    std::span<const ExportedValues> shadings{};   // values for each shading model of the scene
    std::span<const ExportedValues> materials{};  // values for each reflection model of the scene
    ExportedModel shape{};
    ExportedValues shape_values{};
    Transform transform{};
    std::size_t color_texture = k_no_texture;  // of ExportedScene::textures
    bool color_texture_repeats = true;         // beyond its edges; else the colours there go on
};

/// Where within a pixel it is looked at, in pixels from its top left.
struct ExportedSample {
    float x = 0;
    float y = 0;
};

struct ExportedImage {
    int width = 0;  // pixels
    int height = 0;
    std::span<const ExportedSample> samples{};
    Vec3 background{};             // 0-255
    const char* environment = "";  // absolute path of a picture all around; empty: the background
    ColorEncoding color_management = ColorEncoding::srgb;
};

struct ExportedObserver {
    Vec3 position{};
    Vec3 look_at{};
    Vec3 up{};
    Projection projection = Projection::perspective;
    float fov = 0;     // perspective: full vertical angle, degrees
    float height = 0;  // orthographic: metres that fit the picture's height
    // As the scene has them, for users who edit it: `frame_aspect` may have made the above larger for a
    // narrow picture.
    float unfitted_fov = 0;
    float unfitted_height = 0;
};

/// The triangles of one object. Arrays that there are not are null or empty.
struct ExportedMesh {
    std::size_t vertex_count = 0;
    std::span<const std::uint32_t>
        indices{};                    // three vertices a triangle, counter-clockwise seen from outside
    ConstVec3Span position{};         // metres
    ConstVec3Span authored_normal{};  // unit, from the shape; zero at a vertex that has none
    std::span<const std::uint32_t> smooth_group{};  // a vertex each: vertices of one group share a normal
    ConstVec2Span uv{};
    ConstVec3Span color{};  // intensities, 0 to 1, which the object's colour is multiplied with
    ConstVec3Span dpdu{};   // partial derivatives of position
    ConstVec3Span dpdv{};
    bool closed = false;  // else it is seen, and lit, from both sides
    // World space alone:
    std::span<const ConstVec3Span> normals{};   // sets of unit vertex normals, no two of them equal
    std::span<const std::size_t> normals_of{};  // for each shading model of the scene: which of the sets

    constexpr std::size_t triangle_count() const { return indices.size() / 3; }
};

/// Makes the triangles of a scene's objects when they are asked for. Owned by the host. One thread at a time.
class CANDELA_API ExportedGeometry {
  public:
    virtual ~ExportedGeometry();

    /// As the shape makes them, before the object's transform; with texture coordinates, and with derivatives
    /// where a model of the scene needs them. Valid until the next call. May throw.
    virtual ExportedMesh in_object_space(std::size_t object) = 0;

    /// Placed, with vertex normals for each shading model; with texture coordinates and derivatives where a
    /// model of the scene needs them. Valid until the next call. May throw.
    virtual ExportedMesh in_world_space(std::size_t object) = 0;

    /// Whether a shading model of the scene makes the object's vertex normals as models do by default: the
    /// authored ones, else the normalised sum of the normals of the faces around. May throw.
    virtual bool has_default_normals(std::size_t object, std::size_t shading) = 0;
};

/// A scene that has passed all checks, as a target sees it. All memory is the host's and is valid while
/// write() runs. Right-handed, y up, metres.
struct ExportedScene {
    const char* title = "";  // any text
    ExportedImage image{};
    ExportedObserver observer{};
    Vec3 room{};  // the extent of the box around the origin that everything is in; zero: there is none
    std::span<const ExportedModel> light_models{};
    std::span<const ExportedLight> lights{};
    std::span<const ExportedShading> shadings{};        // those of the objects, then those to switch to
    std::span<const ExportedReflection> reflections{};  // likewise
    std::span<const ExportedObject> objects{};
    std::span<const float> tables{};  // the numbers of all kernels' tables, equal ones once
    std::span<const ExportedTexture> textures{};
    bool needs_uv = false;           // a model reads texture coordinates, or an object has a texture
    bool needs_derivatives = false;  // a model reads partial derivatives of positions
    ExportedGeometry* geometry = nullptr;
};

/// Where a target puts its files. Owned by the host, which writes them whole, and none of them where write()
/// throws.
class CANDELA_API FileSink {
  public:
    virtual ~FileSink();
    /// `name` is relative to the program's folder ("shaders/lit.glsl"), without ".."; each is written once.
    /// Throws std::exception where it is not so.
    virtual void write(const char* name, std::span<const std::byte> content) = 0;

    /// Says that the files express a part of the scene only approximately, or leave it out: a sentence
    /// without a full stop that names the part, such as "reflection/ggx becomes a highlight of the same
    /// width". The host refuses the files unless the user accepts approximations; each sentence is said once.
    /// Unless overridden, nothing is done.
    virtual void approximate(const char* sentence);
};

/// What became of a program that has ended.
struct ProgramResult {
    int exit_code = 0;     // 128 + signal where a signal ended it
    const char* out = "";  // what it printed; both belong to the runner and are valid until its next call
    const char* err = "";
};

/// Runs programs of this machine, without a shell. Owned by the host. One thread at a time.
class CANDELA_API ProgramRunner {
  public:
    virtual ~ProgramRunner();
    /// Whether PATH has an executable of that name.
    virtual bool has(const char* program) = 0;
    /// Runs a program, found on PATH where its name has no '/', without input, and waits for it. Throws
    /// std::exception where it cannot be started.
    virtual ProgramResult run(std::span<const char* const> words) = 0;
    /// The same with the streams of the user, who is to see it. Returns its exit code.
    virtual int show(std::span<const char* const> words) = 0;
};

/// What a target can express. The host refuses a scene that needs more before write() is called.
struct TargetAbilities {
    bool models_without_kernel = false;  // of lights, shading and reflection; shapes always have triangles.
                                         // Its files are not made from kernels, but have models of their own
    bool surroundings = false;           // pictures all around, and models that show what is behind an object
    bool triangle = false;               // kernels of shading models that see their triangle: ShadingNeeds
    bool vertex_colors = false;  // ExportedMesh::color; a mesh that has it is refused when it is asked for
    bool textures = false;       // ExportedObject::color_texture
};

/// Something that a scene can be turned into: a program, a page, a file. Any thread.
class CANDELA_API Target : public Instance {
  public:
    ~Target() override;

    virtual TargetAbilities abilities() const noexcept { return {}; }

    /// Writes all files of the scene; the same ones for the same scene. Throws std::exception where it cannot
    /// express the scene.
    virtual void write(const ExportedScene& scene, FileSink& files) const = 0;

    /// The name of the file that a person opens first, one of those that write() writes.
    virtual const char* main_file() const noexcept = 0;

    /// Whether draw() can be called: only then can the target be verified.
    virtual bool can_draw() const noexcept { return false; }

    /// Makes what was written in `directory` ready to run. Unless overridden, nothing has to be done. Throws
    /// std::exception with what the compiler says.
    virtual void build(const char* directory, ProgramRunner& programs) const;

    /// Has what was built draw the scene as it is, without a display, to a PNG file of the image's size.
    /// Throws std::exception.
    virtual void draw(const char* directory, const char* picture, ProgramRunner& programs) const;

    /// Shows a person what was built; returns an exit code. Unless overridden, the desktop opens the main
    /// file.
    virtual int show(const char* directory, ProgramRunner& programs) const;
};

}  // namespace candela
