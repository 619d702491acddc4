// Extensions of Light and ReflectionModel: abilities that only some models have, each a class with one
// function. The class that implements the interface also derives from that of the extension; the host asks
// each instance once, with extension_of(). ScanlineImageFormat is such an extension of ImageFormat.
#pragma once

#include <cstddef>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"
#include "candela/punctual.h"
#include "candela/reflection_model.h"

namespace candela {

/// The extension that the instance offers, or null. A part of the instance.
template <class Extension>
constexpr const Extension* extension_of(const Instance& instance) {
    return dynamic_cast<const Extension*>(&instance);
}

/// A Light whose samples are data. Reflection models may evaluate them without calling the light again.
class CANDELA_EXPORT PunctualSource {
  public:
    virtual ~PunctualSource();

    /// Describes a sample, 0 <= sample < sample_count(): the data sends the same to each receiver as
    /// illuminate(), up to rounding.
    virtual PunctualLight as_punctual(int sample) const = 0;
};

/// A Light whose ambient part is the same for all receivers.
class CANDELA_EXPORT UniformAmbientSource {
  public:
    virtual ~UniformAmbientSource();

    /// Returns the intensity that illuminate_ambient() writes.
    virtual Rgb as_ambient() const = 0;
};

/// A Light from infinitely far away that can be seen, such as a sky: the background of a scene may show it.
class CANDELA_EXPORT SkySource {
  public:
    virtual ~SkySource();

    /// The number of columns that an equirectangular picture of it needs to show all details, at least 2.
    virtual int sky_columns() const noexcept = 0;

    /// Writes the intensity, per channel, that arrives from the directions `towards` (unit vectors). A matt
    /// white surface that sees the same intensity everywhere reflects that intensity, up to sampling.
    virtual void see(std::size_t count, const ConstVec3Span& towards, const Vec3Span& intensity) const = 0;
};

/// A ReflectionModel that evaluates all lights at once, without writing and reading vectors for each light.
/// Models made of kernel functions do.
class CANDELA_EXPORT AllLightsReflection {
  public:
    virtual ~AllLightsReflection();

    /// Writes all that each point reflects of `lighting`: up to rounding, the sum of reflect_ambient() and,
    /// for each light, reflect(). `surface.to_observer` is null. Not called for an EnvironmentReflection.
    virtual void reflect_all_lights(const SurfaceBatch& surface, const PunctualLighting& lighting,
                                    const Vec3Span& intensity) const = 0;
};

/// A ReflectionModel that says how wide its highlight is, so that its surfaces mirror light from everywhere
/// (SkySource) instead of showing its samples.
class CANDELA_EXPORT GlossyReflection {
  public:
    virtual ~GlossyReflection();

    /// Writes the width of each point's highlight, or of its narrowest: alpha of a GGX distribution that is
    /// about as wide, above 0. It says where to look for light, not how much is reflected: reflect() does.
    virtual void highlight_widths(const SurfaceBatch& surface, float* widths) const = 0;
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

/// A ReflectionModel in whose surface, or through it, the environment is visible.
class CANDELA_EXPORT EnvironmentReflection {
  public:
    virtual ~EnvironmentReflection();

    /// The fraction of light, per channel, that is left after `distance` metres inside an object of colour
    /// `color`, for shadows. By default there is none: the object is opaque.
    virtual Rgb transmittance(const Rgb& color, float distance) const;

    /// Adds to `reflected.specular` what each point shows of the environment, by mirroring and refraction
    /// (CA LC1).
    virtual void show_environment(const SurfaceBatch& surface, Environment& environment,
                                  const ReflectedBatch& reflected) const = 0;
};

}  // namespace candela
