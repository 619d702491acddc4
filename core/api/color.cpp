#include "candela/color.h"

#include <algorithm>
#include <cmath>

namespace candela {

float srgb_to_linear(float encoded) noexcept {
    return encoded <= 0.04045f ? encoded / 12.92f : std::pow((encoded + 0.055f) / 1.055f, 2.4f);
}

float linear_to_srgb(float linear) noexcept {
    return linear <= 0.0031308f ? 12.92f * linear : 1.055f * std::pow(linear, 1 / 2.4f) - 0.055f;
}

Rgb decoded(Vec3 color, ColorEncoding encoding) noexcept {
    const auto channel = [&](float x) {
        const float unit = std::min(x, 255.0f) / 255.0f;
        return encoding == ColorEncoding::srgb ? srgb_to_linear(unit) : unit;
    };
    return {channel(color.x), channel(color.y), channel(color.z)};
}

}  // namespace candela
