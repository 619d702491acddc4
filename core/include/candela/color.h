// Colours, and their encoding in scenes and pictures.
#pragma once

#include "candela/math.h"
#include "candela/plugin/export.h"

namespace candela {

/// A colour or an intensity, one value per channel. Scene-linear unless colour management is off.
struct Rgb {
    float r = 0;
    float g = 0;
    float b = 0;

    friend constexpr bool operator==(const Rgb&, const Rgb&) = default;
};

constexpr Rgb operator+(Rgb a, Rgb b) { return {a.r + b.r, a.g + b.g, a.b + b.b}; }
constexpr Rgb operator*(float s, Rgb a) { return {s * a.r, s * a.g, s * a.b}; }

/// How scene colours are read and 8-bit pictures are written (`color_management` in the scene file).
enum class ColorEncoding : int {
    srgb,  // decoded before lighting, encoded again in 8-bit pictures
    none,  // used as they are
};

/// How exposed intensities become those of a display, 0 to 1, before they are clamped and encoded (`tone` in
/// the scene file; candela/kernel/display.kernel).
enum class ToneCurve : int {
    none,
    khronos_neutral,
    aces,
    agx,
    reinhard,
};

/// How an image format stores a channel.
enum class PixelType : int {
    byte,  // 8 bits: exposed, clamped, and encoded as the scene's image says
    real,  // 32-bit float: the computed intensities, neither exposed nor clamped
};

/// The sRGB transfer functions (IEC 61966-2-1:1999): encoded to linear and back, per channel, 0 to 1.
CANDELA_EXPORT float srgb_to_linear(float encoded) noexcept;
CANDELA_EXPORT float linear_to_srgb(float linear) noexcept;

/// A scene colour 0-255 as intensities 0 to 1; 256 counts as 255.
CANDELA_EXPORT Rgb decoded(Vec3 color, ColorEncoding encoding) noexcept;

}  // namespace candela
