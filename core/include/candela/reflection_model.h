// The interface of reflection-model plugins. extensions.h has what a model may offer in addition.
#pragma once

#include <cstddef>
#include <span>

#include "candela/color.h"
#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// A parameter, or one channel of it, that is different at each point.
struct VaryingParameter {
    std::size_t parameter = 0;      // index into the descriptor's parameters; of type real, rgb or color
    std::size_t channel = 0;        // 0 to 2; 0 if it has one number
    const float* values = nullptr;  // of each point, in the parameter's range, as ParamValue::number has them
};

/// Points on one object's surface. World space; all vectors are unit vectors that point away from the
/// surface. A plugin declares its SurfaceNeeds in its descriptor.
struct SurfaceBatch {
    std::size_t count = 0;
    ConstVec3Span normal;         // N
    ConstVec3Span to_observer;    // V; null in reflect_all_lights()
    ConstVec3Span tangent;        // along dp/du, orthogonal to N; null unless needed
    Rgb color;                    // C_o, the object's colour, 0 to 1
    ConstVec3Span position{};     // metres
    ConstVec2Span uv{};           // texture coordinates; null unless needed
    ConstVec3Span point_color{};  // C_o of each point if the object has more than one colour; otherwise null
    /// The others have the instance's values. Empty unless needed; each channel is listed at most once.
    std::span<const VaryingParameter> varying{};
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

/// A reflection model with one set of parameters: a material. Any thread, any batch size from 1; arrays have
/// `count` elements, and nothing outside them may be read or written; they may be unaligned and do not alias.
/// Results are finite and, unless the model declares otherwise, non-negative.
class CANDELA_EXPORT ReflectionModel : public Instance {
  public:
    ~ReflectionModel() override;

    /// Adds what each point reflects of `light` to `reflected.diffuse` and `reflected.specular`.
    virtual void reflect(const SurfaceBatch& surface, const LightingBatch& light,
                         const ReflectedBatch& reflected) const = 0;

    /// Adds what each point reflects of ambient light to `reflected.ambient`.
    virtual void reflect_ambient(const SurfaceBatch& surface, const ConstVec3Span& ambient,
                                 const ReflectedBatch& reflected) const = 0;
};

}  // namespace candela
