// The light that arrives at a batch of points, and how much of it is left by objects in between.
module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <utility>

module candela.shading;

import :guarded;
import :light_visibility;
import candela.api;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

/// A light that is data, at each point. `offset`: where in its extent.
struct PunctualLoop {
    CANDELA_BATCH_LOOP static void run(PunctualLight light, ConstVec3Span position, ConstVec3Span normal,
                                       ConstVec2Span offset, std::size_t count, Vec3Span to_light,
                                       float* distance, float* attenuation) {
        const vec3 source(light.position.x, light.position.y, light.position.z);
        const vec3 u(light.extent_u.x, light.extent_u.y, light.extent_u.z);
        const vec3 v(light.extent_v.x, light.extent_v.y, light.extent_v.z);
        const vec3 axis(light.axis.x, light.axis.y, light.axis.z);
        const bool is_distant = light.w == 0.0f;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 at = source + u * offset.x[i] + v * offset.y[i];
            const vec3 to_source = at - kernel::load(position, i) * light.w;
            const float square = kernel::dot(to_source, to_source);
            const float inverse = kernel::inversesqrt(kernel::max(square, 1.0e-36f));
            const vec3 l = square > 1.0e-36f ? to_source * inverse : kernel::load(normal, i);
            const float away = square * inverse;
            const float r = kernel::max(away, 1.0e-4f);
            const float cosine = -kernel::dot(l, axis);
            const float t = kernel::clamp((cosine - light.cos_outer) * light.cone_scale, 0.0f, 1.0f);
            const float smooth = t * t * (3.0f - 2.0f * t);
            const float cone = light.has_cone ? (light.is_smooth ? smooth : t) : 1.0f;
            kernel::store(to_light, i, l);
            distance[i] = is_distant ? std::numeric_limits<float>::infinity() : away;
            attenuation[i] = cone / (light.constant + r * (light.linear + r * light.quadratic));
        }
    }
};

struct IntensityLoop {
    CANDELA_BATCH_LOOP static void run(Rgb intensity, const float* attenuation, std::size_t count,
                                       Vec3Span to) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i)
            kernel::store(to, i, vec3(intensity.r, intensity.g, intensity.b) * attenuation[i]);
    }
};

/// Zero exactly where no light arrives.
struct BrightnessLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span a, ConstVec3Span b, std::size_t count, float* to) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 sum = kernel::load(a, i) + kernel::load(b, i);
            to[i] = sum.x + sum.y + sum.z;
        }
    }
};

struct ProductLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span by, std::size_t count, Vec3Span v) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i)
            kernel::store(v, i, kernel::load(ConstVec3Span(v), i) * kernel::load(by, i));
    }
};

/// Whether a sample of a light is more than a point.
bool is_extended(const PunctualLight& sample) {
    return sample.extent_u != Vec3{} || sample.extent_v != Vec3{};
}

}  // namespace

bool RenderLight::has_extent() const { return data && std::ranges::any_of(data->samples, is_extended); }

std::span<const float* const> SurfaceShader::visibility_of_data(const LightsAtOnce& all,
                                                                const SurfacePoints& points) {
    const std::size_t lights = all.punctual.size();
    weights_.resize((lights + 1) * k_batch_size);
    weight_pointers_.resize(lights);
    float* const everywhere = &weights_[lights * k_batch_size];
    std::fill_n(everywhere, points.filled, 1.0f);
    bool is_any_blocked = false;
    for (std::size_t k = 0; k < lights; ++k) {
        const std::uint32_t packets = all.is_blocked[k] ? visibility_->packets_to_trace(all.punctual[k]) : 0;
        if (packets == 0) {
            weight_pointers_[k] = everywhere;
            continue;
        }
        is_any_blocked = true;
        LightSample light = light_at(all.punctual[k], 0, points);
        light.packets = packets;
        const ConstVec3Span left = visibility_->find(light);
        float* const weights = &weights_[k * k_batch_size];
        std::copy_n(left.x, points.filled, weights);
        weight_pointers_[k] = weights;
    }
    if (!is_any_blocked) return {};
    return weight_pointers_;
}

LightSample SurfaceShader::light_at(const PunctualLight& light, int sample, const SurfacePoints& points) {
    const ConstVec2Span offset = is_extended(light) ? visibility_->sample_offsets(sample)
                                                    : ConstVec2Span{zeros_.data(), zeros_.data()};
    multiversion<PunctualLoop>(light, points.position.span(), std::as_const(normal_).span(), offset,
                               points.filled, to_light_.span(), distance_.data(), attenuation_.data());
    const bool varies = is_extended(light) && scene_.pattern == ShadowPattern::varied;
    return {std::as_const(to_light_).span(), distance_.data(), attenuation_.data(), varies ? sample : -1};
}

std::optional<LightSample> SurfaceShader::illuminate(const RenderLight& source, int sample,
                                                     const SurfacePoints& points, std::size_t count) {
    const Vec3Span to_light = to_light_.span(), diffuse = light_diffuse_.span(),
                   specular = light_specular_.span();
    const bool is_blocked = has_shadows_ && source.casts_shadows;
    if (is_blocked && source.data) {
        const PunctualLight& light = source.data->samples[static_cast<std::size_t>(sample)];
        LightSample at = light_at(light, sample, points);
        multiversion<IntensityLoop>(light.diffuse, at.brightness, count, diffuse);
        multiversion<IntensityLoop>(light.specular, at.brightness, count, specular);
        at.packets = visibility_->packets_to_trace(light);
        if (at.packets == 0) return std::nullopt;
        return at;
    }
    if (is_blocked) std::fill_n(distance_.begin(), points.filled, std::numeric_limits<float>::infinity());
    guarded(PluginKind::light, source.plugin, [&] {
        source.light->illuminate(
            sample,
            {.count = count, .position = points.position.span(), .normal = std::as_const(normal_).span()},
            {to_light, diffuse, specular, is_blocked ? distance_.data() : nullptr});
    });
    if (!is_blocked) return std::nullopt;
    multiversion<BrightnessLoop>(ConstVec3Span(diffuse), ConstVec3Span(specular), count, attenuation_.data());
    return LightSample{std::as_const(to_light_).span(), distance_.data(), attenuation_.data()};
}

void SurfaceShader::block(const LightSample& light, std::size_t count) {
    const ConstVec3Span left = visibility_->find(light);
    multiversion<ProductLoop>(left, count, light_diffuse_.span());
    multiversion<ProductLoop>(left, count, light_specular_.span());
}

void SurfaceShader::illuminate_ambient(const RenderLight& source, const SurfacePoints& points,
                                       std::size_t count) {
    guarded(PluginKind::light, source.plugin, [&] {
        source.light->illuminate_ambient(
            {.count = count, .position = points.position.span(), .normal = std::as_const(normal_).span()},
            light_diffuse_.span());
    });
}

bool SurfaceShader::block_ambient(const RenderLight& source, std::size_t count) {
    if (!has_shadows_ || source.ambient_occlusion.rays == 0) return false;
    const ConstVec3Span free = visibility_->find_ambient(source.ambient_occlusion);
    multiversion<ProductLoop>(free, count, light_diffuse_.span());
    return true;
}

}  // namespace candela
