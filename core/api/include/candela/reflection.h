// The interface of reflection-model plugins.
#pragma once

#include <cstddef>

#include "candela/api.h"
#include "candela/color.h"
#include "candela/descriptor.h"
#include "candela/math.h"
#include "candela/punctual.h"

namespace candela {

/// Points on one object's surface. World space; all vectors are unit vectors that point away from the
/// surface.
struct SurfaceBatch {
    std::size_t count = 0;
    ConstVec3Span normal;         // N
    ConstVec3Span to_observer;    // V; null in reflect_punctual()
    ConstVec3Span tangent;        // along dp/du, orthogonal to N; null unless needs_tangent()
    Rgb color;                    // C_o, the object's colour, 0 to 1
    ConstVec3Span position{};     // metres
    ConstVec2Span uv{};           // texture coordinates; null unless needs_uv()
    ConstVec3Span point_color{};  // C_o of each point, where the object has more than one; else null
};

/// What one sample of a light sends to each of the points.
struct LightingBatch {
    ConstVec3Span to_light;  // L
    ConstVec3Span diffuse;   // intensity per channel
    ConstVec3Span specular;
};

/// Reflected intensity per channel, in separate parts (CA IM3, IM4; DD6 adds them up). A model adds to the
/// existing values.
struct ReflectedBatch {
    Vec3Span ambient;   // I_a
    Vec3Span diffuse;   // I_d
    Vec3Span specular;  // I_s
};

/// Where rays within an object leave it. World space.
struct ExitBatch {
    Vec3Span position;
    Vec3Span normal;            // unit, from the object's shading model; points away from the surface
    float* distance = nullptr;  // along the ray, metres; negative where the surface is open: no exit
};

/// What surrounds an object. Light stays local (CA AS2): no other object is seen. Owned by the host; used for
/// one batch, by one thread.
class CANDELA_API Surroundings {
  public:
    virtual ~Surroundings();

    /// Writes the intensity, per channel, that arrives from far away in the directions `towards` (unit
    /// vectors).
    virtual void look(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) = 0;

    /// The largest intensity, of all channels, that arrives from anywhere: what bounds the light that is lost
    /// where a ray is not followed any further.
    virtual float max_intensity() const noexcept = 0;

    /// Follows rays within the object from `origin`, on its surface, along `direction` (unit vectors) to
    /// where they leave it. Arrays do not alias.
    virtual void leave(std::size_t count, const ConstVec3Span& origin, const ConstVec3Span& direction,
                       const ExitBatch& exit) = 0;
};

/// A reflection model with one set of parameters: a material. Any thread, any batch size from 1; arrays have
/// `count` elements, and nothing outside them may be read or written; they need no alignment and do not
/// alias. Results are finite and, unless the model declares otherwise, not negative.
class CANDELA_API ReflectionModel : public Instance {
  public:
    ~ReflectionModel() override;

    /// Whether SurfaceBatch::tangent must be filled.
    virtual bool needs_tangent() const noexcept { return false; }

    /// Whether SurfaceBatch::uv must be filled. Zero on a mesh without texture coordinates.
    virtual bool needs_uv() const noexcept { return false; }

    /// Whether the model's kernel reads Surface::position, for programs that are generated from it;
    /// SurfaceBatch::position is there in any case.
    virtual bool needs_position() const noexcept { return false; }

    /// Adds what each point reflects of the light to `reflected.diffuse` and `reflected.specular`.
    virtual void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                         const ReflectedBatch& reflected) const = 0;

    /// Adds what each point reflects of ambient light to `reflected.ambient`.
    virtual void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                                 const ReflectedBatch& reflected) const = 0;

    /// Writes all that each point reflects of `lighting`: what reflect_ambient() and, for each light,
    /// reflect() add up to, but for rounding. Models that are made of kernel functions have it: what it saves
    /// is writing and reading vectors for each light. False, with nothing written, if the model leaves it to
    /// those. Never called for models that show their surroundings.
    virtual bool reflect_punctual(const SurfaceBatch& surface, const PunctualLighting& lighting,
                                  const Vec3Span& intensity) const;

    /// Whether the surroundings are visible in the surface or through it, so that show_surroundings() is
    /// called.
    virtual bool shows_surroundings() const noexcept { return false; }

    /// Adds to `reflected.specular` what each point shows of the surroundings, by mirroring and refraction
    /// (CA LC1).
    virtual void show_surroundings(const SurfaceBatch& surface, Surroundings& surroundings,
                                   const ReflectedBatch& reflected) const;
};

}  // namespace candela
