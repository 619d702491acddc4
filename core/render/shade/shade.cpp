module;

#include "candela/batch.h"
#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <span>
#include <string>
#include <utility>
#include <vector>

module candela.shade;

import :guarded;
import :surroundings;
import candela.diagnostics;
import candela.guard;
import candela.library;
import candela.light;
import candela.raster;
import candela.registry;
import candela.shading;
import candela.transform;

namespace candela {

namespace {

using kernel::vec3;

/// V: towards the eye, or against the view direction in an orthographic picture.
struct ToObserverLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, ConstVec3Span position, std::size_t count,
                                       Vec3Span to_observer) {
        const bool perspective = camera.projection == Projection::perspective;
        const Vec3 against = -camera.forward;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = perspective ? camera.eye - position[i] : against;
            kernel::store(to_observer, i, kernel::normalize(vec3(d.x, d.y, d.z)));
        }
    }
};

struct FlipLoop {
    CANDELA_BATCH_LOOP static void run(const float* facing, std::size_t count, Vec3Span v) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::store(v, i, kernel::load(v, i) * facing[i]);
        }
    }
};

/// dp/du without its part along N (Gram-Schmidt).
struct TangentLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span dpdu, ConstVec3Span normal, std::size_t count,
                                       Vec3Span tangent) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 n = kernel::load(normal, i);
            const vec3 u = kernel::load(dpdu, i);
            kernel::store(tangent, i, kernel::normalize(u - n * kernel::dot(n, u)));
        }
    }
};

struct SumLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span a, ConstVec3Span d, ConstVec3Span s, std::size_t count,
                                       Vec3Span sum) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            kernel::store(sum, i, kernel::load(a, i) + kernel::load(d, i) + kernel::load(s, i));
        }
    }
};

/// The largest magnitude among many numbers; a non-finite number counts as larger than all finite ones.
/// Without their sign, the bits of floats are in the same order as integers, whose maximum is vectorised.
struct LargestLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span v, std::size_t count, std::int32_t* bits) {
        constexpr std::int32_t k_magnitude = 0x7fff'ffff;
        std::int32_t largest = *bits;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t x = std::bit_cast<std::int32_t>(v.x[i]) & k_magnitude;
            const std::int32_t y = std::bit_cast<std::int32_t>(v.y[i]) & k_magnitude;
            const std::int32_t z = std::bit_cast<std::int32_t>(v.z[i]) & k_magnitude;
            const std::int32_t xy = x > y ? x : y;
            const std::int32_t xyz = xy > z ? xy : z;
            largest = largest > xyz ? largest : xyz;
        }
        *bits = largest;
    }
};

float largest_of(ConstVec3Span v, std::size_t count) {
    std::int32_t bits = 0;
    std::int32_t* const result = &bits;
    multiversion<LargestLoop>(v, count, result);
    return std::bit_cast<float>(bits);
}

/// The guard after the batch arrays' last element, in floats.
constexpr std::size_t k_guard_size = 16;

void clear(const Vec3Span& span, std::size_t count) {
    for (float* const channel : {span.x, span.y, span.z}) std::fill_n(channel, count, 0.0f);
}

/// How many points of a batch are lit: whole vectors, unless rays are followed from each of them.
std::size_t lit_of(const SurfaceModels& surface, const SurfacePoints& points) {
    return surface.reflection->shows_surroundings() ? points.count : points.filled;
}

}  // namespace

PointNeeds SurfaceModels::needs() const {
    const ShadingNeeds needs = shading->needs();
    return {.uv = needs.uv || reflection->needs_uv(),
            .derivatives = needs.derivatives || reflection->needs_tangent(),
            .triangle = needs.triangle};
}

void shading_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal) {
    const ShadingNeeds needs = surface.shading->needs();
    TriangleBatch triangle;
    const bool has_triangle = needs.triangle && surface.shading->shading_rate() != ShadingRate::vertex;
    for (std::size_t k = 0; has_triangle && k < 3; ++k) {
        triangle.position[k] = points.corner_position[k].span();
        triangle.normal[k] = points.corner_normal[k].span();
    }
    const ShadingPointBatch batch{
        .count = points.filled,
        .face_normal = points.face_normal.span(),
        .vertex_normal = points.vertex_normal.span(),
        .barycentric = points.barycentric.span(),
        .uv = needs.uv ? ConstVec2Span{points.u.data(), points.v.data()} : ConstVec2Span{},
        .dpdu = needs.derivatives ? points.dpdu.span() : ConstVec3Span{},
        .dpdv = needs.derivatives ? points.dpdv.span() : ConstVec3Span{},
        .triangle = has_triangle ? &triangle : nullptr};
    surface.shading->normals(batch, normal);
}

SurfaceShader::SurfaceShader() {
    for (Vec3Arrays* const arrays : {&to_observer_, &tangent_}) arrays->resize(k_batch_size);
    for (Vec3Arrays* const arrays : written_by_plugins()) arrays->resize(k_batch_size + k_guard_size);
    mark_ends();
}

SurfaceShader::~SurfaceShader() = default;

void SurfaceShader::begin(const LitScene& scene) {
    scene_ = scene;
    surroundings_.reset();
}

std::array<Vec3Arrays*, 7> SurfaceShader::written_by_plugins() {
    return {&normal_, &to_light_, &light_diffuse_, &light_specular_, &ambient_, &diffuse_, &specular_};
}

void SurfaceShader::mark_ends() {
    for (Vec3Arrays* const arrays : written_by_plugins()) {
        for (AlignedVector<float>* const array : {&arrays->x, &arrays->y, &arrays->z})
            fill_with_guard(std::span(*array).subspan(k_batch_size));
    }
}

bool SurfaceShader::are_ends_intact() {
    bool intact = true;
    for (const Vec3Arrays* const arrays : written_by_plugins()) {
        for (const AlignedVector<float>* const array : {&arrays->x, &arrays->y, &arrays->z})
            intact &= is_guard_intact(std::span(*array).subspan<k_batch_size, k_guard_size>());
    }
    return intact;
}

void SurfaceShader::require_sound(PluginKind kind, const std::string& plugin, std::size_t count,
                                  std::initializer_list<const Vec3Arrays*> results) {
    const auto fail = [&](const char* what) {
        throw Error(ErrorCategory::failure, fmt::format("plugin {}/{} {}", name_of(kind), plugin, what),
                    {Help::Topic::plugin_conformance});
    };
    if (!are_ends_intact()) {
        mark_ends();
        fail("writes beyond the batch that it is given");
    }
    for (const Vec3Arrays* arrays : results) {
        if (!std::isfinite(largest_of(arrays->span(), count)))
            fail("gives a result that is no finite number");
    }
}

void SurfaceShader::find_normals(const SurfaceModels& surface, const SurfacePoints& points) {
    guarded(PluginKind::shading, surface.shading_plugin,
            [&] { shading_normals(surface, points, normal_.span()); });
    if (points.any_from_behind) multiversion<FlipLoop>(points.facing.data(), points.filled, normal_.span());
}

float SurfaceShader::shade(const SurfaceModels& surface, const Interior& interior,
                           const SurfacePoints& points, const Vec3Span& intensity) {
    add_up(surface, interior, points, Scrutiny::none);
    const std::size_t count = lit_of(surface, points);
    multiversion<SumLoop>(std::as_const(ambient_).span(), std::as_const(diffuse_).span(),
                          std::as_const(specular_).span(), count, intensity);
    const float largest = largest_of(ConstVec3Span(intensity), count);
    if (!std::isfinite(largest) || !are_ends_intact()) add_up(surface, interior, points, Scrutiny::each_step);
    return largest;
}

SurfaceBatch SurfaceShader::lit_surface(const SurfaceModels& surface, const SurfacePoints& points,
                                        std::size_t count) const {
    const ReflectionModel& model = *surface.reflection;
    return {.count = count,
            .normal = normal_.span(),
            .to_observer = to_observer_.span(),
            .tangent = model.needs_tangent() ? tangent_.span() : ConstVec3Span{},
            .color = surface.color,
            .position = points.position.span(),
            .uv = model.needs_uv() ? ConstVec2Span{points.u.data(), points.v.data()} : ConstVec2Span{}};
}

void SurfaceShader::add_up(const SurfaceModels& surface, const Interior& interior,
                           const SurfacePoints& points, Scrutiny scrutiny) {
    const std::size_t count = lit_of(surface, points);
    const auto look_at = [&](PluginKind kind, const std::string& plugin,
                             std::initializer_list<const Vec3Arrays*> results) {
        if (scrutiny == Scrutiny::each_step) require_sound(kind, plugin, count, results);
    };
    if (scrutiny == Scrutiny::each_step) mark_ends();
    find_normals(surface, points);
    look_at(PluginKind::shading, surface.shading_plugin, {&normal_});
    const ConstVec3Span normal = std::as_const(normal_).span();
    multiversion<ToObserverLoop>(scene_.camera, points.position.span(), count, to_observer_.span());
    if (surface.reflection->needs_tangent())
        multiversion<TangentLoop>(points.dpdu.span(), normal, count, tangent_.span());

    const ReceiverBatch receivers{.count = count, .position = points.position.span(), .normal = normal};
    const SurfaceBatch batch = lit_surface(surface, points, count);
    const ReflectedBatch reflected{ambient_.span(), diffuse_.span(), specular_.span()};
    for (const Vec3Span& sum : {reflected.ambient, reflected.diffuse, reflected.specular}) clear(sum, count);

    for (const LitSource& source : scene_.lights) {
        for (int sample = 0; sample < source.light->sample_count(); ++sample) {
            guarded(PluginKind::light, source.plugin, [&] {
                source.light->illuminate(sample, receivers,
                                         {to_light_.span(), light_diffuse_.span(), light_specular_.span()});
            });
            look_at(PluginKind::light, source.plugin, {&to_light_, &light_diffuse_, &light_specular_});
            guarded(PluginKind::reflection, surface.reflection_plugin, [&] {
                surface.reflection->reflect(
                    batch, {to_light_.span(), light_diffuse_.span(), light_specular_.span()}, reflected);
            });
            look_at(PluginKind::reflection, surface.reflection_plugin, {&diffuse_, &specular_});
        }
        if (source.light->has_ambient()) {
            guarded(PluginKind::light, source.plugin,
                    [&] { source.light->illuminate_ambient(receivers, light_diffuse_.span()); });
            look_at(PluginKind::light, source.plugin, {&light_diffuse_});
            guarded(PluginKind::reflection, surface.reflection_plugin,
                    [&] { surface.reflection->reflect_ambient(batch, light_diffuse_.span(), reflected); });
            look_at(PluginKind::reflection, surface.reflection_plugin, {&ambient_});
        }
    }
    if (surface.reflection->shows_surroundings()) {
        if (surroundings_ == nullptr)
            surroundings_ = std::make_unique<ObjectSurroundings>(*scene_.environment);
        surroundings_->set_object(surface, interior);
        guarded(PluginKind::reflection, surface.reflection_plugin,
                [&] { surface.reflection->show_surroundings(batch, *surroundings_, reflected); });
        look_at(PluginKind::reflection, surface.reflection_plugin, {&specular_});
    }
}

}  // namespace candela
