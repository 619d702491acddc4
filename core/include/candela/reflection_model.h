// The interface of reflection-model plugins.
#pragma once

#include <cstddef>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"
#include "candela/punctual.h"

namespace candela {

/// Points on one object's surface. World space; all vectors are unit vectors that point away from the
/// surface.
struct SurfaceBatch {
    std::size_t count = 0;
    ConstVec3Span normal;         // N
    ConstVec3Span to_observer;    // V; null in reflect_all_lights()
    ConstVec3Span tangent;        // along dp/du, orthogonal to N; null unless needs_tangent()
    Rgb color;                    // C_o, the object's colour, 0 to 1
    ConstVec3Span position{};     // metres
    ConstVec2Span uv{};           // texture coordinates; null unless needs_uv()
    ConstVec3Span point_color{};  // C_o of each point if the object has more than one colour; otherwise null
};

/// The light that one sample of a light source sends to each of the points.
struct LightingBatch {
    ConstVec3Span to_light;  // L
    ConstVec3Span diffuse;   // intensity per channel
    ConstVec3Span specular;
};

/// Reflected intensity per channel, in separate parts (CA IM3, IM4), which DD6 adds up. A model adds to the
/// existing values.
struct ReflectedBatch {
    Vec3Span ambient;   // I_a
    Vec3Span diffuse;   // I_d
    Vec3Span specular;  // I_s
};

/// The points at which rays leave an object from inside. World space.
struct ExitBatch {
    Vec3Span position;
    Vec3Span normal;            // unit, from the object's shading model; points away from the surface
    float* distance = nullptr;  // along the ray, metres; negative if the ray meets an opening: no exit
};

/// The world around an object. Light stays local (CA AS2): other objects are not seen. Owned by the host;
/// used for one batch, by one thread.
class CANDELA_EXPORT Environment {
  public:
    virtual ~Environment();

    /// Writes the intensity, per channel, that arrives from infinity in the directions `towards` (unit
    /// vectors).
    virtual void look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) = 0;

    /// The largest intensity, over all channels, that arrives from any direction: an upper bound for the
    /// light lost when a ray is no longer followed.
    virtual float max_intensity() const noexcept = 0;

    /// Follows rays inside the object from `origin`, on its surface, along `direction` (unit vectors) to the
    /// points where they leave it. Arrays do not alias.
    virtual void trace_exit(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                            const ExitBatch& exit) = 0;
};

/// A reflection model with one set of parameters: a material. Any thread, any batch size from 1; arrays have
/// `count` elements, and nothing outside them may be read or written; they may be unaligned and do not alias.
/// Results are finite and, unless the model declares otherwise, non-negative.
class CANDELA_EXPORT ReflectionModel : public Instance {
  public:
    ~ReflectionModel() override;

    /// Whether SurfaceBatch::tangent must be filled.
    virtual bool needs_tangent() const noexcept { return false; }

    /// Whether SurfaceBatch::uv must be filled. Zero on a mesh without texture coordinates.
    virtual bool needs_uv() const noexcept { return false; }

    /// Whether the model's kernel reads Surface::position; generated programs depend on it.
    /// SurfaceBatch::position is always filled.
    virtual bool needs_position() const noexcept { return false; }

    /// Adds what each point reflects of `light` to `reflected.diffuse` and `reflected.specular`.
    virtual void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                         const ReflectedBatch& reflected) const = 0;

    /// Adds what each point reflects of ambient light to `reflected.ambient`.
    virtual void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                                 const ReflectedBatch& reflected) const = 0;

    /// Writes all that each point reflects of `lighting`: up to rounding, the sum of reflect_ambient() and,
    /// for each light, reflect(). Models made of kernel functions implement it, which avoids writing and
    /// reading vectors for each light. Returns false, and writes nothing, if the model does not support it.
    /// Never called for models that show their environment.
    virtual bool reflect_all_lights(const SurfaceBatch& surface, const PunctualLighting& lighting,
                                    const Vec3Span& intensity) const;

    /// Whether the environment is visible in the surface or through it, so that show_environment() is
    /// called.
    virtual bool shows_environment() const noexcept { return false; }

    /// Adds to `reflected.specular` what each point shows of the environment, by mirroring and refraction
    /// (CA LC1).
    virtual void show_environment(const SurfaceBatch& surface, Environment& environment,
                                  const ReflectedBatch& reflected) const;
};

}  // namespace candela
