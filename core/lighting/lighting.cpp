module;

#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <cstddef>
#include <span>
#include <string>
#include <utility>

module candela.lighting;

import candela.plugins;

namespace candela {

namespace {

using kernel::vec3;

/// V: towards the eye, or against the view in an orthographic picture.
struct ToObserverLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, ConstVec3Span position, std::size_t count,
                                       Vec3Span to_observer) {
        const bool perspective = camera.projection == Projection::perspective;
        const Vec3 against = -camera.forward;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = perspective ? camera.eye - position[i] : against;
            const vec3 v = kernel::normalize(vec3(d.x, d.y, d.z));
            to_observer.x[i] = v.x;
            to_observer.y[i] = v.y;
            to_observer.z[i] = v.z;
        }
    }
};

struct FlipLoop {
    CANDELA_BATCH_LOOP static void run(const float* facing, std::size_t count, Vec3Span v) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            v.x[i] *= facing[i];
            v.y[i] *= facing[i];
            v.z[i] *= facing[i];
        }
    }
};

/// dp/du without its part along N (Gram-Schmidt).
struct TangentLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span dpdu, ConstVec3Span normal, std::size_t count,
                                       Vec3Span tangent) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 n(normal.x[i], normal.y[i], normal.z[i]);
            const vec3 u(dpdu.x[i], dpdu.y[i], dpdu.z[i]);
            const vec3 t = kernel::normalize(u - n * kernel::dot(n, u));
            tangent.x[i] = t.x;
            tangent.y[i] = t.y;
            tangent.z[i] = t.z;
        }
    }
};

struct SumLoop {
    CANDELA_BATCH_LOOP static void run(ConstVec3Span a, ConstVec3Span d, ConstVec3Span s, std::size_t count,
                                       Vec3Span sum) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            sum.x[i] = a.x[i] + d.x[i] + s.x[i];
            sum.y[i] = a.y[i] + d.y[i] + s.y[i];
            sum.z[i] = a.z[i] + d.z[i] + s.z[i];
        }
    }
};

void clear(const Vec3Span& span, std::size_t count) {
    for (float* const channel : {span.x, span.y, span.z}) std::fill_n(channel, count, 0.0f);
}

/// What a plugin throws, as an error that names it.
template <class Call>
void guarded(PluginKind kind, const std::string& plugin, Call call) {
    try {
        call();
    } catch (...) {
        rethrow_as_plugin_error(kind, plugin);
    }
}

}  // namespace

PointNeeds SurfaceModels::needs() const {
    const ShadingNeeds needs = shading->needs();
    return {.uv = needs.uv, .derivatives = needs.derivatives || reflection->needs_tangent()};
}

Lighting::Lighting(std::span<const LitSource> lights, const Camera& camera)
    : lights_(lights), camera_(camera) {
    for (Vec3Arrays* const arrays : {&normal_, &to_observer_, &tangent_, &to_light_, &light_diffuse_,
                                     &light_specular_, &ambient_, &diffuse_, &specular_}) {
        arrays->resize(k_batch_size);
    }
}

void Lighting::find_normals(const SurfaceModels& surface, const SurfacePoints& points) {
    const ShadingNeeds needs = surface.shading->needs();
    const ShadingPointBatch batch{
        .count = points.count,
        .face_normal = points.face_normal.span(),
        .vertex_normal = points.vertex_normal.span(),
        .barycentric = points.barycentric.span(),
        .uv = needs.uv ? ConstVec2Span{points.u.data(), points.v.data()} : ConstVec2Span{},
        .dpdu = needs.derivatives ? points.dpdu.span() : ConstVec3Span{},
        .dpdv = needs.derivatives ? points.dpdv.span() : ConstVec3Span{}};
    guarded(PluginKind::shading, surface.shading_plugin,
            [&] { surface.shading->normals(batch, normal_.span()); });
    multiversion<FlipLoop>(points.facing.data(), points.count, normal_.span());
}

void Lighting::light(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& intensity) {
    const std::size_t count = points.count;
    find_normals(surface, points);
    const ConstVec3Span normal = std::as_const(normal_).span();
    multiversion<ToObserverLoop>(camera_, points.position.span(), count, to_observer_.span());
    const bool needs_tangent = surface.reflection->needs_tangent();
    if (needs_tangent) multiversion<TangentLoop>(points.dpdu.span(), normal, count, tangent_.span());

    const ReceiverBatch receivers{.count = count, .position = points.position.span(), .normal = normal};
    const SurfaceBatch batch{.count = count,
                             .normal = normal,
                             .to_observer = to_observer_.span(),
                             .tangent = needs_tangent ? ConstVec3Span(tangent_.span()) : ConstVec3Span{},
                             .color = surface.color};
    const ReflectedBatch reflected{ambient_.span(), diffuse_.span(), specular_.span()};
    for (const Vec3Span& sum : {reflected.ambient, reflected.diffuse, reflected.specular}) clear(sum, count);

    for (const LitSource& source : lights_) {
        for (int sample = 0; sample < source.light->sample_count(); ++sample) {
            guarded(PluginKind::light, source.plugin, [&] {
                source.light->illuminate(sample, receivers,
                                         {to_light_.span(), light_diffuse_.span(), light_specular_.span()});
            });
            guarded(PluginKind::reflection, surface.reflection_plugin, [&] {
                surface.reflection->reflect(
                    batch, {to_light_.span(), light_diffuse_.span(), light_specular_.span()}, reflected);
            });
        }
        if (source.light->has_ambient()) {
            guarded(PluginKind::light, source.plugin,
                    [&] { source.light->illuminate_ambient(receivers, light_diffuse_.span()); });
            guarded(PluginKind::reflection, surface.reflection_plugin,
                    [&] { surface.reflection->reflect_ambient(batch, light_diffuse_.span(), reflected); });
        }
    }
    multiversion<SumLoop>(std::as_const(ambient_).span(), std::as_const(diffuse_).span(),
                          std::as_const(specular_).span(), count, intensity);
}

}  // namespace candela
