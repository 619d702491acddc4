module;

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>
#include <string_view>
#include <vector>

module candela.scene;

import candela.api;
import candela.plugins;

namespace candela {

std::string Label::text() const {
    return name.empty() ? fmt::format("number {}", number) : fmt::format("'{}'", name);
}

float exposure_factor(float ev100) noexcept {
    return ev100 == k_unexposed ? 1.0f : 1 / (1.2f * std::exp2(ev100));
}

std::string_view name_of(ToneCurve tone) noexcept {
    return std::array<std::string_view, 5>{"none", "khronos-neutral", "aces", "agx",
                                           "reinhard"}[static_cast<std::size_t>(tone)];
}

Observer fitted(Observer observer, int width, int height) {
    const double aspect = static_cast<double>(width) / height, frame = double{observer.frame_aspect};
    observer.frame_aspect = 0;
    if (aspect >= frame) return observer;
    constexpr double k_half_degree = std::numbers::pi / 360;
    const double widening = frame / aspect;
    observer.height = static_cast<float>(widening * observer.height);
    observer.fov =
        static_cast<float>(std::atan(widening * std::tan(observer.fov * k_half_degree)) / k_half_degree);
    return observer;
}

bool CommonMaterial::has_texture(std::string_view parameter) const {
    return std::ranges::find(textures, parameter, &ParameterTexture::parameter) != textures.end();
}

bool CommonMaterial::emits() const {
    return emission_strength > 0 && (emission != Vec3{} || has_texture("emission"));
}

bool CommonMaterial::is_see_through() const {
    return has_texture("opacity") || (opacity_cutoff > 0 ? opacity < opacity_cutoff : opacity < 1);
}

bool operator==(const Scene& a, const Scene& b) {
    return a.room == b.room && a.observer == b.observer && a.image == b.image &&
           a.constraints == b.constraints && a.shadows == b.shadows && a.lights == b.lights &&
           a.objects == b.objects && a.animation == b.animation;
}

}  // namespace candela
