// The interface of light plugins. extensions.h has what a light may offer in addition.
#pragma once

#include <cstddef>

#include "candela/math.h"
#include "candela/plugin/descriptor.h"
#include "candela/plugin/export.h"

namespace candela {

/// Points that a light illuminates. World space, metres; normals are unit vectors.
struct ReceiverBatch {
    std::size_t count = 0;
    ConstVec3Span position;
    ConstVec3Span normal;
};

/// The directions from which one sample of a light arrives, and what each receiver gets from it. Written by
/// the light.
struct IncidentBatch {
    Vec3Span to_light;  // unit vectors from the receiver towards the light
    Vec3Span diffuse;   // intensity per channel, >= 0, attenuated
    Vec3Span specular;  // like `diffuse`, for highlights
    /// The distance from each receiver to the source, metres, beyond which nothing blocks the light. Null
    /// unless there are shadows; infinite if the light leaves it as it is.
    float* distance = nullptr;
};

/// A light. Any thread, any batch size from 1; arrays have `count` elements, and nothing outside them may be
/// read or written; they may be unaligned and do not alias. All intensities are >= 0 and finite, even where a
/// receiver coincides with the light.
class CANDELA_EXPORT Light : public Instance {
  public:
    ~Light() override;

    /// The number of directions from which the light reaches a point: 0 for ambient light, 1 for a point
    /// light, more for a source modelled by several points (RE: "we model a distributed source by using a
    /// number of point light sources").
    virtual int sample_count() const noexcept = 0;

    /// Writes what sample `sample`, 0 <= sample < sample_count(), sends. The samples of a light add up.
    virtual void illuminate(int sample, const ReceiverBatch& receivers, const IncidentBatch& incident) const;

    /// Writes the intensity of the part that comes from everywhere (CA DD3), per channel. Never attenuated.
    /// By default there is none: see PluginDescriptor::has_ambient.
    virtual void illuminate_ambient(const ReceiverBatch& receivers, const Vec3Span& ambient) const;
};

}  // namespace candela
