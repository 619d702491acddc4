// The keys of every material: emission, the occlusion of ambient light, and opacity.
module;

#include <algorithm>
#include <array>
#include <cstddef>
#include <optional>

module candela.shading;

import :clearing;
import :common_material;
import candela.api;
import candela.raster;

namespace candela {

void find_emission(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
                   const Vec3Span& values) {
    clear(values, count);
    add_emission(surface, points, count, values);
}

void add_emission(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
                  const Vec3Span& intensity) {
    const std::array factors{surface.emission.r, surface.emission.g, surface.emission.b};
    const std::array sums{intensity.x, intensity.y, intensity.z};
    const std::size_t first = surface.material_textures.emission;
    for (std::size_t c = 0; c < sums.size(); ++c) {
        if (first == MaterialTextures::k_none) {
            for (std::size_t i = 0; i < count; ++i) sums[c][i] += factors[c];
        } else {
            const float* const texture = points.parameters[first + c].data();
            for (std::size_t i = 0; i < count; ++i) sums[c][i] += factors[c] * texture[i];
        }
    }
}

float occlusion_at(const SurfaceModels& surface, const SurfacePoints& points, std::size_t point) {
    const std::size_t number = surface.material_textures.occlusion;
    return number == MaterialTextures::k_none ? surface.occlusion : points.parameters[number][point];
}

void occlude(const SurfaceModels& surface, const SurfacePoints& points, std::size_t count,
             const Vec3Span& ambient) {
    for (std::size_t i = 0; i < count; ++i) {
        const float open = occlusion_at(surface, points, i);
        ambient.set(i, {open * ambient.x[i], open * ambient.y[i], open * ambient.z[i]});
    }
}

std::optional<float> uniform_opacity(const SurfaceModels& surface) {
    if (surface.opacity_textures.arrays() > 0) return std::nullopt;
    if (surface.opacity_cutoff <= 0) return surface.opacity;
    return surface.opacity >= surface.opacity_cutoff ? 1.0f : 0.0f;
}

void find_opacity(const SurfaceModels& surface, SurfacePoints& points, float* opacity) {
    if (const std::optional<float> uniform = uniform_opacity(surface)) {
        std::fill_n(opacity, points.count, *uniform);
        return;
    }
    const std::size_t factors = surface.opacity_textures.arrays();
    while (points.parameters.size() < factors) points.parameters.emplace_back(k_batch_size);
    evaluate(surface.opacity_textures, points.filled, textured(points), points.parameters);
    std::copy_n(points.parameters.front().data(), points.count, opacity);
    for (std::size_t k = 1; k < factors; ++k)
        for (std::size_t i = 0; i < points.count; ++i) opacity[i] *= points.parameters[k][i];
    if (const float cutoff = surface.opacity_cutoff; cutoff > 0)
        for (std::size_t i = 0; i < points.count; ++i) opacity[i] = opacity[i] >= cutoff ? 1.0f : 0.0f;
}

}  // namespace candela
