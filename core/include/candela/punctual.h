// Punctual lights as data that reflection models evaluate in their own loop, for many lights at once.
#pragma once

#include <span>

#include "candela/color.h"
#include "candela/math.h"

namespace candela {

/// A light, or one sample of a light, that reaches each point from one direction: a point, spot or
/// directional light (RTR4 section 5.2, "punctual lights"; glTF's KHR_lights_punctual). World space.
struct PunctualLight {
    /// Homogeneous: with w = 1 a position in metres; with w = 0 the unit vector towards an infinitely distant
    /// light.
    Vec3 position{};
    float w = 1;
    Rgb diffuse{};  // intensity per channel, >= 0, before attenuation
    Rgb specular{};
    /// Attenuation at distance r, at least a tenth of a millimetre: 1 / (constant + linear r + quadratic
    /// r^2).
    float constant = 1;
    float linear = 0;
    float quadratic = 0;
    /// The cone of a spot light. With t = clamp((cos - cos_outer) cone_scale, 0, 1), where cos is the cosine
    /// of the angle between the unit vector `axis` and the direction to the point, the light is multiplied by
    /// t^2 (3 - 2t) if the cone is smooth, otherwise by t.
    bool has_cone = false;
    bool is_smooth = false;
    Vec3 axis{};
    float cos_outer = -1;
    float cone_scale = 0;
    /// The part of a line or rectangle that this sample stands for, as its edges; zero for a point. With
    /// shadows, the position varies over it, centred on `position`.
    Vec3 extent_u{};
    Vec3 extent_v{};
};

/// All the light that a batch of points receives, as data.
struct PunctualLighting {
    /// Homogeneous: with w = 1 the eye, in metres; with w = 0 the unit vector towards an infinitely distant
    /// observer. V is the direction of observer - w position.
    Vec3 observer{};
    float w = 1;
    Rgb ambient{};  // equal at all points
    std::span<const PunctualLight> lights{};
    /// For each light, the fraction of it that reaches each point of the batch; empty: all of it.
    std::span<const float* const> visibility{};
};

}  // namespace candela
