module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <utility>

module candela.shading;

import :clearing;
import :light_visibility;
import :surface_shader;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

/// How far from a point's surface its rays start, at least `least`.
[[gnu::always_inline]] inline float margin_at(vec3 p, float least) {
    const float largest = kernel::max(kernel::max(kernel::abs(p.x), kernel::abs(p.y)), kernel::abs(p.z));
    return kernel::max(least, OcclusionTree::k_relative_margin * largest);
}

/// Rays from a batch's points to a light. They start a margin above the surface, or below it where it faces
/// away from the light, and end a margin before the light. Above, they also start a margin before the point,
/// so that walls that meet in it are in the way and light does not leak through corners; below, a margin
/// after it, so that they start inside the object also at its corners. At vertices, which are the corners,
/// they also start further inside.
struct AimLoop {
    struct Points {
        ConstVec3Span position, face_normal, normal;
        const float* facing;
        float margin;   // at least
        bool from_all;  // also where the shading normal faces away
        std::uint32_t count;
        ConstVec3Span inside;  // of the triangle, or of the mesh
        float inward;          // how many margins along the surface towards it
    };

    CANDELA_BATCH_LOOP static void run(Points points, ConstVec3Span to_light, const float* distance,
                                       const float* brightness, std::size_t count, Vec3Span origin,
                                       Vec3Span direction, float* length, std::uint32_t* flags) {
        const float always = points.from_all ? 1.0f : 0.0f;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 p = kernel::load(points.position, i);
            const vec3 l = kernel::load(to_light, i);
            const vec3 n = kernel::load(points.face_normal, i) * points.facing[i];
            const float margin = margin_at(p, points.margin);
            // Light that only models ask for that wrap it around always comes from below, whichever way the
            // triangle faces: otherwise its edges would show.
            const float cosine = kernel::dot(kernel::load(points.normal, i), l);
            const bool is_below = kernel::min(kernel::dot(n, l), cosine) < 0.0f;
            const vec3 to_inside = kernel::normalize(kernel::load(points.inside, i) - p);
            const vec3 along = to_inside - n * kernel::dot(n, to_inside);
            const vec3 shift =
                (n * 2.0f - l) * (is_below ? -margin : margin) + along * (points.inward * margin);
            kernel::store(origin, i, p + shift);
            // From there to the light itself, so that the ray ends before a surface on which the light is.
            kernel::store(direction, i, l - shift * (1.0f / distance[i]));
            const float to = distance[i] * 0.9999990f - 2.0f * margin;
            length[i] = to;
            const bool faces = kernel::max(cosine, always) > 0.0f;
            // A faulty plugin's direction must not reach Embree, and a point that is not there needs no ray.
            const bool is_sound = kernel::dot(l, l) < 4.0f && static_cast<std::uint32_t>(i) < points.count;
            const bool is_lit = faces && is_sound && brightness[i] > 0.0f && to > 2.0f * margin;
            std::uint32_t flag = ShadowRays::k_traced;
            flag |= is_below ? ShadowRays::k_from_below : 0u;
            flag |= points.facing[i] < 0.0f ? ShadowRays::k_from_behind : 0u;
            flags[i] = is_lit ? flag : 0u;
        }
    }
};

/// Moves points to where other samples of their pixels see the plane of their triangles, if the whole pixel
/// sees it, and aims at the light from there.
struct SampleLoop {
    struct View {
        Vec3 eye, right, down, forward;  // `right`, `down`: to the sample, at distance one or everywhere
        bool is_perspective;
    };

    CANDELA_BATCH_LOOP static void run(View view, ConstVec3Span position, ConstVec3Span face_normal,
                                       const float* coverage, ConstVec3Span to_light, const float* distance,
                                       std::size_t count, Vec3Span to, Vec3Span direction, float* length) {
        const vec3 eye(view.eye.x, view.eye.y, view.eye.z);
        const vec3 forward(view.forward.x, view.forward.y, view.forward.z);
        const vec3 step(view.right.x + view.down.x, view.right.y + view.down.y, view.right.z + view.down.z);
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 p = kernel::load(position, i), n = kernel::load(face_normal, i);
            const vec3 seen = p - eye;
            const float depth = view.is_perspective ? kernel::dot(seen, forward) : 1.0f;
            const vec3 across = step * depth;
            const vec3 line = view.is_perspective ? seen + across : forward;
            const float cosine = kernel::dot(n, line);
            const float along = kernel::dot(n, across) / (cosine == 0.0f ? 1.0f : cosine);
            const bool moves = coverage[i] == 1.0f && cosine != 0.0f;
            const vec3 shift = moves ? across - line * along : vec3(0.0f);
            const vec3 l = kernel::load(to_light, i);
            const bool is_near = distance[i] < std::numeric_limits<float>::infinity();
            const vec3 to_source = is_near ? l * distance[i] - shift : l;
            const float r = kernel::sqrt(kernel::dot(to_source, to_source));
            kernel::store(to, i, p + shift);
            // Points that stay where they are keep their rays, so that no rounding tells batches apart.
            kernel::store(direction, i, moves && r > 0.0f ? to_source * (1.0f / r) : l);
            length[i] = moves && is_near ? r : distance[i];
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

/// Whether the normal turns away from a light as one moves towards it across a triangle: the surface that the
/// triangle stands for is hollow there.
bool is_hollow(const Mesh& mesh, std::uint32_t triangle, float facing, Vec3 to_light) {
    const MeshVertex* corner[3];
    for (std::size_t k = 0; k < 3; ++k)
        corner[k] = &mesh.vertices[mesh.indices[3 * std::size_t{triangle} + k]];
    // The gradient of N.L times L, up to a positive factor.
    const Vec3 aside = cross(to_light, mesh.face_normal.span()[triangle]);
    float turn = 0;
    for (std::size_t k = 0; k < 3; ++k) {
        const Vec3 opposite = corner[(k + 2) % 3]->position - corner[(k + 1) % 3]->position;
        turn += dot(opposite, aside) * dot(corner[k]->normal, to_light);
    }
    return facing * turn < 0;
}

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
    for (Vec3Arrays* const arrays :
         {&inside_, &origin_, &towards_, &direction_, &colored_, &mean_, &position_, &first_})
        arrays->resize(k_batch_size);
    for (AlignedVector<float>* const array :
         {&length_, &visible_, &offset_x_, &offset_y_, &distance_, &brightness_})
        array->resize(k_batch_size);
    flags_.resize(k_batch_size);
}

void LightVisibility::begin(const LightingContext& scene) {
    tree_ = scene.occlusion;
    transmitters_ = scene.transmitters;
    is_varied_ = scene.pattern == ShadowPattern::varied;
    pattern_ = sample_pattern(scene.samples);
    camera_ = scene.camera;
}

bool LightVisibility::set_points(const SurfaceModels& surface, const ShadedObject& object,
                                 const SurfacePoints& points, const ConstVec3Span& normal) {
    if (tree_ == nullptr || !object.receives_shadows) return false;
    mesh_ = object.mesh;
    object_ = object.index;
    lights_below_horizon_ = surface.lights_below_horizon;
    points_ = &points;
    normal_ = normal;
    count_ = whole_vectors(points.count);
    has_region_ = has_packets_ = false;
    find_inside();
    return true;
}

void LightVisibility::find_inside() {
    // The least angle between an edge of a triangle and the way to its centroid is often some 18 degrees:
    // four margins lead away from the edge by more than the one that leads back, towards the light.
    inward_ = !points_->has_triangle ? 2.0f : tree_->is_solid(object_) ? 0.0f : 4.0f;
    if (inward_ == 0) return;
    const Vec3Span inside = inside_.span();
    if (!points_->has_triangle) {
        const Vec3 middle = 0.5f * (mesh_->bounds.low + mesh_->bounds.high);
        for (std::size_t i = 0; i < count_; ++i) inside.set(i, middle);
        return;
    }
    for (std::size_t i = 0; i < points_->count; ++i) {
        Vec3 sum{};
        for (std::size_t k = 0; k < 3; ++k)
            sum = sum + mesh_->vertices[mesh_->indices[3 * std::size_t{points_->triangle[i]} + k]].position;
        inside.set(i, 1 / 3.0f * sum);
    }
}

void LightVisibility::aim(const LightSample& light, const ConstVec3Span& position) {
    const AimLoop::Points points{.position = position,
                                 .face_normal = points_->face_normal.span(),
                                 .normal = normal_,
                                 .facing = points_->facing.data(),
                                 .margin = tree_->least_margin(),
                                 .from_all = lights_below_horizon_,
                                 .count = static_cast<std::uint32_t>(points_->count),
                                 .inside = std::as_const(inside_).span(),
                                 .inward = inward_};
    if (light.brightness == nullptr) std::fill_n(visible_.begin(), count_, 1.0f);
    const float* const brightness = light.brightness != nullptr ? light.brightness : visible_.data();
    multiversion<AimLoop>(points, light.to_light, light.distance, brightness, count_, origin_.span(),
                          towards_.span(), length_.data(), flags_.data());
    for (std::size_t i = 0; i < count_ / OcclusionTree::k_packet; ++i) {
        if ((light.packets >> i & 1) == 0)
            std::fill_n(&flags_[i * OcclusionTree::k_packet], OcclusionTree::k_packet, 0u);
    }
    std::uint32_t all = 0;
    for (std::size_t i = 0; i < count_; ++i) all |= flags_[i];
    const bool any_from_below = (all & ShadowRays::k_from_below) != 0;
    if (any_from_below && points_->has_triangle && !mesh_->is_faceted) lift_from_hollows(light, position);
}

void LightVisibility::lift_from_hollows(const LightSample& light, const ConstVec3Span& position) {
    for (std::size_t i = 0; i < points_->count; ++i) {
        if ((flags_[i] & ShadowRays::k_from_below) == 0) continue;
        const Vec3 l = light.to_light[i], p = position[i];
        if (!(dot(normal_[i], l) > 0) || !is_hollow(*mesh_, points_->triangle[i], points_->facing[i], l))
            continue;
        flags_[i] &= ~ShadowRays::k_from_below;
        const float margin = margin_at({p.x, p.y, p.z}, tree_->least_margin());
        const Vec3 n = points_->facing[i] * points_->face_normal.span()[i];
        const Vec3 across = 2 * margin * (2.0f * n - l);  // to the other side of the surface
        origin_.span().set(i, std::as_const(origin_).span()[i] + across);
        towards_.span().set(i, std::as_const(towards_).span()[i] - 1 / light.distance[i] * across);
    }
}

ConstVec3Span LightVisibility::find(const LightSample& light) {
    const ConstVec3Span position = points_->position.span();
    const std::span coverage(points_->coverage.data(), points_->count);
    if (pattern_.size() == 1 || std::ranges::none_of(coverage, [](float part) { return part == 1; }))
        return trace(light, position);
    const int samples = static_cast<int>(pattern_.size());
    if (light.varied >= 0)
        return trace(from_sample(light, light.varied % samples), std::as_const(position_).span());
    // Four samples show whether the edge of a shadow may cross the pixel; only then are the others traced.
    // From the last one on, because the outer ones are at the end.
    constexpr int k_first = 4;
    const Vec3Span mean = mean_.span(), first = first_.span();
    clear(mean, count_);
    std::copy_n(light.brightness, count_, brightness_.begin());
    const LightSample rest{.to_light = light.to_light,
                           .distance = light.distance,
                           .brightness = brightness_.data(),
                           .packets = light.packets};
    for (int k = 0; k < k_first; ++k) add_sample(rest, samples - 1 - k);
    bool is_done = true;
    for (std::size_t i = 0; i < count_; ++i) {
        first.set(i, 1.0f / k_first * mean[i]);
        const Vec3 seen = first[i];
        const bool is_uniform = seen == Vec3{1, 1, 1} || seen == Vec3{} || points_->coverage[i] != 1;
        if (is_uniform) brightness_[i] = 0;
        is_done = is_done && is_uniform;
    }
    if (is_done || samples == k_first) return std::as_const(first_).span();
    for (int k = k_first; k < samples; ++k) add_sample(rest, samples - 1 - k);
    for (std::size_t i = 0; i < count_; ++i) {
        if (brightness_[i] > 0) first.set(i, 1 / static_cast<float>(samples) * mean[i]);
    }
    return std::as_const(first_).span();
}

void LightVisibility::move_in_pixels(const LightSample& light, float right, float below) {
    const float per_pixel = 1 / camera_.pixels_per_unit;
    const SampleLoop::View view{.eye = camera_.eye,
                                .right = right * per_pixel * camera_.right,
                                .down = -below * per_pixel * camera_.up,
                                .forward = camera_.forward,
                                .is_perspective = camera_.projection == Projection::perspective};
    multiversion<SampleLoop>(view, points_->position.span(), points_->face_normal.span(),
                             points_->coverage.data(), light.to_light, light.distance, count_,
                             position_.span(), direction_.span(), distance_.data());
}

LightSample LightVisibility::from_sample(const LightSample& light, int sample) {
    const auto [x, y] = pattern_[static_cast<std::size_t>(sample)];
    move_in_pixels(light, static_cast<float>(x - 8) / 16, static_cast<float>(y - 8) / 16);
    return {.to_light = std::as_const(direction_).span(),
            .distance = distance_.data(),
            .brightness = light.brightness,
            .packets = light.packets};
}

void LightVisibility::add_sample(const LightSample& light, int sample) {
    const ConstVec3Span left = trace(from_sample(light, sample), std::as_const(position_).span());
    const Vec3Span mean = mean_.span();
    multiversion<AddLoop>(left, count_, mean);
}

ConstVec3Span LightVisibility::trace(const LightSample& light, const ConstVec3Span& position) {
    aim(light, position);
    crossings_.clear();
    passages_.clear();
    tree_->find_visible({.count = count_,
                         .origin = std::as_const(origin_).span(),
                         .direction = std::as_const(towards_).span(),
                         .length = length_.data(),
                         .flags = flags_.data(),
                         .object = object_},
                        visible_.data(), crossings_, &passages_);
    if (!passages_.empty()) pass_through_surfaces();
    return traced();
}

void LightVisibility::pass_through_surfaces() {
    // Batches of points on one object.
    std::ranges::stable_sort(passages_, {}, &Passage::object);
    for (std::size_t first = 0; first < passages_.size();) {
        std::size_t end = first + 1;
        while (end < passages_.size() && end - first < k_batch_size &&
               passages_[end].object == passages_[first].object)
            ++end;
        pass_through(std::span(passages_).subspan(first, end - first));
        first = end;
    }
}

void LightVisibility::pass_through(std::span<const Passage> passages) {
    const Transmitter& through = transmitters_[passages.front().object];
    const std::optional<float> uniform = uniform_opacity(*through.surface);
    if (!uniform) {
        if (passed_ == nullptr) passed_ = std::make_unique<SurfacePoints>();
        std::array<std::uint32_t, k_batch_size> triangles;
        passed_at_.resize(k_batch_size);
        for (std::size_t i = 0; i < passages.size(); ++i) {
            triangles[i] = passages[i].triangle;
            passed_at_.span().set(i, passages[i].barycentric);
        }
        gather_places(*through.mesh, std::span(triangles).first(passages.size()),
                      std::as_const(passed_at_).span(), k_opacity_needs, *passed_);
        // With the finest texels: it is not known how far apart rays are.
        for (AlignedVector<float>* const array :
             {&passed_->dudx, &passed_->dvdx, &passed_->dudy, &passed_->dvdy})
            std::ranges::fill(*array, 0.0f);
        opacity_.resize(k_batch_size);
        find_opacity(*through.surface, *passed_, opacity_.data());
    }
    for (std::size_t i = 0; i < passages.size(); ++i)
        visible_[passages[i].ray] *= 1 - (uniform ? *uniform : opacity_[i]);
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
    std::fill_n(distance_.begin(), count_, occlusion.distance);
    const Vec3Span mean = mean_.span();
    clear(mean, count_);
    for (int k = 0; k < occlusion.rays; ++k) {
        multiversion<HemisphereLoop>(normal_, offset.x, offset.y, static_cast<float>(k), rays, count_,
                                     direction_.span());
        const LightSample towards{std::as_const(direction_).span(), distance_.data()};
        const ConstVec3Span free = trace(towards, points_->position.span());
        multiversion<AddLoop>(free, count_, mean);
    }
    const float share = 1 / rays;
    multiversion<ScaleLoop>(share, count_, mean);
    return std::as_const(mean_).span();
}

std::optional<Blocker> LightVisibility::find_blocker(const LightSample& light) {
    for (int sample = -1; sample < static_cast<int>(pattern_.size()); ++sample) {
        const bool is_middle = sample < 0;
        const LightSample from = is_middle ? light : from_sample(light, sample);
        aim(from, is_middle ? points_->position.span() : std::as_const(position_).span());
        if (flags_[0] == 0) continue;
        const auto blocker = tree_->find_blocker({.count = 1,
                                                  .origin = std::as_const(origin_).span(),
                                                  .direction = std::as_const(towards_).span(),
                                                  .length = length_.data(),
                                                  .flags = flags_.data(),
                                                  .object = object_},
                                                 0);
        if (blocker) return blocker;
    }
    return std::nullopt;
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
