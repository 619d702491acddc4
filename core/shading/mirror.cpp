// The mirror image of lights from everywhere: see candela/kernel/mirror.kernel.
module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <bit>
#include <cstddef>
#include <memory>
#include <utility>

module candela.shading;

import :clearing;
import :common_material;
import :guarded;
import candela.api;
import candela.plugins;
import candela.raster;
import candela.util;

namespace candela::kernel {

namespace {

/// The argument of mirror.kernel's functions.
struct RadianceMap {
    const float* texels;
    int size;
    int last_level;
    float density;
};

CANDELA_KERNEL_INLINE int radiance_size(RadianceMap m, int level) { return m.size >> level; }
CANDELA_KERNEL_INLINE int radiance_last_level(RadianceMap m) { return m.last_level; }
CANDELA_KERNEL_INLINE vec3 radiance_texel(RadianceMap m, int level, int x, int y) {
    const int size = m.size >> level;
    const int texels_before = (m.size * m.size - size * size) / 3 * 4;
    const int at = 3 * (texels_before + y * size + x);
    return vec3(m.texels[at], m.texels[at + 1], m.texels[at + 2]);
}

// As in radiance.kernel, without inner loops, which are not vectorised.

CANDELA_KERNEL_INLINE vec3 radiance_texel_around(RadianceMap m, int level, int x, int y) {
    const int last = (m.size >> level) - 1;
    const int row = x < 0 || x > last ? last - y : y;
    const int column = x < 0 ? 0 : (x > last ? last : x);
    const int turned = row < 0 || row > last ? last - column : column;
    const int bounded = row < 0 ? 0 : (row > last ? last : row);
    return radiance_texel(m, level, turned, bounded);
}

CANDELA_KERNEL_INLINE vec3 radiance_in_level(RadianceMap m, int level, vec2 place) {
    const auto size = static_cast<float>(m.size >> level);
    const float x = place.x * size - 0.5f, y = place.y * size - 0.5f;
    const float left = floor(x), top = floor(y);
    const int column = static_cast<int>(left), row = static_cast<int>(top);
    const vec3 upper = mix(radiance_texel_around(m, level, column, row),
                           radiance_texel_around(m, level, column + 1, row), x - left);
    const vec3 lower = mix(radiance_texel_around(m, level, column, row + 1),
                           radiance_texel_around(m, level, column + 1, row + 1), x - left);
    return mix(upper, lower, y - top);
}

CANDELA_KERNEL_INLINE vec3 radiance_at(RadianceMap m, vec2 place, float level) {
    const auto last = static_cast<float>(m.last_level);
    const float wanted = clamp(level, 0.0f, last), finer = floor(wanted);
    const vec3 fine = radiance_in_level(m, static_cast<int>(finer), place);
    const vec3 coarse = radiance_in_level(m, static_cast<int>(min(finer + 1.0f, last)), place);
    return mix(fine, coarse, wanted - finer);
}

#if !defined(__cpp_aggregate_paren_init)
#define MirrorSample(...) \
    MirrorSample { __VA_ARGS__ }
#endif
#include "candela/kernel/mirror.kernel"

}  // namespace

}  // namespace candela::kernel

namespace candela {

namespace {

using kernel::vec3;

/// Makes widths of whatever a faulty plugin returned.
struct BoundedWidthLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, float* widths) {
        constexpr float k_narrowest = 1.0e-4f, k_widest = 1.0f;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i)
            widths[i] = widths[i] > k_narrowest ? kernel::min(widths[i], k_widest) : k_narrowest;
    }
};

struct ShareLoop {
    CANDELA_BATCH_LOOP static void run(float density, ConstVec3Span normal, ConstVec3Span to_observer,
                                       ConstVec3Span to_light, const float* widths, std::size_t count,
                                       Vec3Span specular) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float share =
                kernel::highlight_share(density, kernel::load(normal, i), kernel::load(to_observer, i),
                                        kernel::load(to_light, i), widths[i]);
            kernel::store(specular, i, kernel::load(ConstVec3Span(specular), i) * share);
        }
    }
};

struct MirrorLoop {
    CANDELA_BATCH_LOOP static void run(kernel::RadianceMap map, int index, ConstVec3Span normal,
                                       ConstVec3Span to_observer, const float* widths, std::size_t count,
                                       Vec3Span to_light, Vec3Span specular) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const kernel::MirrorSample sample = kernel::mirror_sample(
                map, kernel::load(normal, i), kernel::load(to_observer, i), widths[i], index);
            kernel::store(to_light, i, sample.to_light);
            kernel::store(specular, i, sample.intensity);
        }
    }
};

kernel::RadianceMap map_of(const RadianceMap& radiance) {
    const auto size = static_cast<unsigned>(radiance.size());
    return {radiance.texels().data(), radiance.size(), std::countr_zero(size), radiance.density()};
}

}  // namespace

void RenderLight::find_radiance() {
    if (sky == nullptr || radiance != nullptr) return;
    guarded(PluginKind::light, plugin,
            [&] { radiance = std::make_shared<const RadianceMap>(*sky, light->sample_count()); });
}

bool SurfaceShader::mirrors(const SurfaceModels& surface, const RenderLight& source) const {
    return surface.glossy_reflection != nullptr && source.radiance != nullptr &&
           source.radiance->density() > 0;
}

void SurfaceShader::find_widths(const SurfaceModels& surface, const SurfaceBatch& batch) {
    guarded(PluginKind::reflection, surface.reflection_plugin,
            [&] { surface.glossy_reflection->highlight_widths(batch, widths_.data()); });
    multiversion<BoundedWidthLoop>(batch.count, widths_.data());
}

void SurfaceShader::share_with_mirror(const RenderLight& source, std::size_t count) {
    // Samples of most lights are distant, so that the first point stands for all.
    const vec3 towards = kernel::load(std::as_const(to_light_).span(), 0);
    const float density = kernel::light_density(map_of(*source.radiance), kernel::radiance_place(towards));
    multiversion<ShareLoop>(density, std::as_const(normal_).span(), std::as_const(to_observer_).span(),
                            std::as_const(to_light_).span(), std::as_const(widths_).data(), count,
                            light_specular_.span());
}

void SurfaceShader::add_mirrored(const RenderLight& source, const SurfaceModels& surface,
                                 const SurfacePoints& points, const SurfaceBatch& batch,
                                 const ReflectedBatch& reflected) {
    const kernel::RadianceMap map = map_of(*source.radiance);
    clear(light_diffuse_.span(), batch.count);
    for (int index = 0; index < kernel::mirror_samples(); ++index) {
        multiversion<MirrorLoop>(map, index, std::as_const(normal_).span(),
                                 std::as_const(to_observer_).span(), std::as_const(widths_).data(),
                                 batch.count, to_light_.span(), light_specular_.span());
        if (surface.is_occluded()) occlude(surface, points, batch.count, light_specular_.span());
        guarded(PluginKind::reflection, surface.reflection_plugin, [&] {
            surface.reflection->reflect(
                batch, {to_light_.span(), light_diffuse_.span(), light_specular_.span()}, reflected);
        });
    }
}

}  // namespace candela
