module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>

module candela.shading;

import :light_visibility;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

/// Rays from a batch's points to a light. They start a margin above the surface, or below it where it faces
/// away from the light, and end a margin before the light.
struct AimLoop {
    struct Points {
        ConstVec3Span position, face_normal, normal;
        const float* facing;
        float margin;   // at least
        bool from_all;  // also where the shading normal faces away
    };

    CANDELA_BATCH_LOOP static void run(Points points, ConstVec3Span to_light, const float* distance,
                                       const float* brightness, std::size_t count, Vec3Span origin,
                                       float* length, std::uint32_t* flags) {
        const float always = points.from_all ? 1.0f : 0.0f;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 p = kernel::load(points.position, i);
            const vec3 l = kernel::load(to_light, i);
            const vec3 n = kernel::load(points.face_normal, i) * points.facing[i];
            const float largest =
                kernel::max(kernel::max(kernel::abs(p.x), kernel::abs(p.y)), kernel::abs(p.z));
            const float margin = kernel::max(points.margin, OcclusionTree::k_relative_margin * largest);
            const bool is_below = kernel::dot(n, l) < 0.0f;
            kernel::store(origin, i, p + n * (is_below ? -margin : margin));
            const float to = distance[i] * 0.9999990f - 2.0f * margin;
            length[i] = to;
            const bool faces = kernel::max(kernel::dot(kernel::load(points.normal, i), l), always) > 0.0f;
            const bool is_lit = faces && brightness[i] > 0.0f && to > 0.0f;
            std::uint32_t flag = ShadowRays::k_traced;
            flag |= is_below ? ShadowRays::k_from_below : 0u;
            flag |= points.facing[i] < 0.0f ? ShadowRays::k_from_behind : 0u;
            flags[i] = is_lit ? flag : 0u;
        }
    }
};

/// Where in its extent a light is sampled. Pixel by pixel, and sample by sample, Kronecker sequences: the
/// multiples of powers of the generalised golden ratio in four and two dimensions (Roberts 2018, "The
/// unreasonable effectiveness of quasirandom sequences"), as integers, so that all programs agree.
struct OffsetLoop {
    CANDELA_BATCH_LOOP static void run(const std::uint32_t* x, const std::uint32_t* y, std::uint32_t sample,
                                       std::size_t count, float* to_x, float* to_y) {
        const std::uint32_t u = sample * 3242174889u, v = sample * 2447445414u;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const auto a = static_cast<std::int32_t>(x[i] * 3679390609u + y[i] * 3152041523u + u);
            const auto b = static_cast<std::int32_t>(x[i] * 2700274806u + y[i] * 2313257605u + v);
            to_x[i] = static_cast<float>(a >> 8) * 0x1p-24f;
            to_y[i] = static_cast<float>(b >> 8) * 0x1p-24f;
        }
    }
};

/// Directions around the normals, distributed by the cosine; number `k` of `of`, turned by the offsets.
struct HemisphereLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span normal, const float* offset_x, const float* offset_y,
                                       float k, float of, std::size_t count, Vec3Span direction) {
        const float turn = 0.61803399f * k;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float square = (k + 0.5f + offset_x[i]) / of;
            const float angle = 6.2831853f * kernel::fract(turn + 0.5f + offset_y[i]);
            const float radius = kernel::sqrt(square);
            const float x = radius * kernel::cos(angle), y = radius * kernel::sin(angle);
            const float z = kernel::sqrt(1.0f - square);
            const vec3 n = kernel::load(normal, i);
            // Duff et al. (2017), "Building an orthonormal basis, revisited".
            const float sign = n.z < 0.0f ? -1.0f : 1.0f;
            const float a = -1.0f / (sign + n.z), b = n.x * n.y * a;
            const vec3 tangent(1.0f + sign * n.x * n.x * a, sign * b, -sign * n.x);
            const vec3 bitangent(b, sign + n.y * n.y * a, -n.y);
            kernel::store(direction, i, tangent * x + bitangent * y + n * z);
        }
    }
};

struct AddLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span each, std::size_t count, Vec3Span sum) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i)
            kernel::store(sum, i, kernel::load(ConstVec3Span(sum), i) + kernel::load(each, i));
    }
};

struct ScaleLoop {
    CANDELA_BATCH_LOOP static void run(float by, std::size_t count, Vec3Span v) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) kernel::store(v, i, kernel::load(ConstVec3Span(v), i) * by);
    }
};

}  // namespace

LightVisibility::LightVisibility() {
    for (Vec3Arrays* const arrays : {&origin_, &direction_, &colored_, &mean_}) arrays->resize(k_batch_size);
    for (AlignedVector<float>* const array : {&length_, &visible_, &offset_x_, &offset_y_})
        array->resize(k_batch_size);
    flags_.resize(k_batch_size);
}

void LightVisibility::begin(const LightingContext& scene) {
    tree_ = scene.occlusion;
    transmitters_ = scene.transmitters;
    is_varied_ = scene.pattern == ShadowPattern::varied;
}

bool LightVisibility::set_points(const SurfaceModels& surface, const ShadedObject& object,
                                 const SurfacePoints& points, const ConstVec3Span& normal) {
    if (tree_ == nullptr || !object.receives_shadows) return false;
    object_ = object.index;
    lights_below_horizon_ = surface.lights_below_horizon;
    points_ = &points;
    normal_ = normal;
    count_ = whole_vectors(points.count);
    return true;
}

void LightVisibility::aim(const LightSample& light, bool from_all) {
    const AimLoop::Points points{.position = points_->position.span(),
                                 .face_normal = points_->face_normal.span(),
                                 .normal = normal_,
                                 .facing = points_->facing.data(),
                                 .margin = tree_->least_margin(),
                                 .from_all = from_all};
    if (light.brightness == nullptr) std::fill_n(visible_.begin(), count_, 1.0f);
    const float* const brightness = light.brightness != nullptr ? light.brightness : visible_.data();
    multiversion<AimLoop>(points, light.to_light, light.distance, brightness, count_, origin_.span(),
                          length_.data(), flags_.data());
}

ConstVec3Span LightVisibility::find(const LightSample& light) {
    aim(light, lights_below_horizon_);
    crossings_.clear();
    tree_->find_visible({.count = count_,
                         .origin = std::as_const(origin_).span(),
                         .direction = light.to_light,
                         .length = length_.data(),
                         .flags = flags_.data(),
                         .object = object_},
                        visible_.data(), crossings_);
    return traced();
}

ConstVec3Span LightVisibility::traced() {
    const float* const visible = visible_.data();
    if (crossings_.empty()) return {visible, visible, visible};
    for (AlignedVector<float>* const channel : {&colored_.x, &colored_.y, &colored_.z})
        std::copy_n(visible, count_, channel->begin());
    for (const Crossing& crossing : crossings_) {
        const Transmitter& through = transmitters_[crossing.object];
        const Rgb left = through.model->transmittance(through.color, crossing.length);
        colored_.x[crossing.ray] *= left.r;
        colored_.y[crossing.ray] *= left.g;
        colored_.z[crossing.ray] *= left.b;
    }
    return std::as_const(colored_).span();
}

ConstVec3Span LightVisibility::find_ambient(const AmbientOcclusion& occlusion) {
    const ConstVec2Span offset = sample_offsets(0);
    const auto rays = static_cast<float>(occlusion.rays);
    AlignedVector<float> distance(k_batch_size, occlusion.distance);
    const Vec3Span mean = mean_.span();
    for (float* const channel : {mean.x, mean.y, mean.z}) std::fill_n(channel, count_, 0.0f);
    for (int k = 0; k < occlusion.rays; ++k) {
        multiversion<HemisphereLoop>(normal_, offset.x, offset.y, static_cast<float>(k), rays, count_,
                                     direction_.span());
        const LightSample towards{std::as_const(direction_).span(), distance.data()};
        const ConstVec3Span free = find(towards);
        multiversion<AddLoop>(free, count_, mean);
    }
    const float share = 1 / rays;
    multiversion<ScaleLoop>(share, count_, mean);
    return std::as_const(mean_).span();
}

std::optional<Blocker> LightVisibility::find_blocker(const LightSample& light) {
    aim(light, lights_below_horizon_);
    if (flags_[0] == 0) return std::nullopt;
    return tree_->find_blocker({.count = 1,
                                .origin = std::as_const(origin_).span(),
                                .direction = light.to_light,
                                .length = length_.data(),
                                .flags = flags_.data(),
                                .object = object_},
                               0);
}

ConstVec2Span LightVisibility::sample_offsets(int sample) {
    if (is_varied_) {
        multiversion<OffsetLoop>(points_->pixel_x.data(), points_->pixel_y.data(),
                                 static_cast<std::uint32_t>(sample), count_, offset_x_.data(),
                                 offset_y_.data());
    } else {
        std::fill_n(offset_x_.begin(), count_, 0.0f);
        std::fill_n(offset_y_.begin(), count_, 0.0f);
    }
    return {offset_x_.data(), offset_y_.data()};
}

}  // namespace candela
