// Normals from pictures: normal maps, and bump maps, whose heights have been made slopes.
module;

#include "candela/kernel/batch.h"
#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <utility>

module candela.shading;

import :object_environment;
import :texels;
import candela.api;
import candela.plugins;
import candela.raster;
import candela.scene;
import candela.util;

namespace candela {

namespace {

using kernel::vec3;

struct AtPoints {
    ConstVec3Span texel, dpdu, dpdv;
};

/// On a triangle without area in its texture coordinates, a tilted normal may vanish.
vec3 unit_or(vec3 v, vec3 otherwise) {
    return kernel::dot(v, v) > 1.0e-20f ? kernel::normalize(v) : otherwise;
}

/// Along T = dp/du without its part along N, B = N x T or its opposite, on the side of dp/dv, and N.
struct NormalMapLoop {
    CANDELA_BATCH_LOOP static void run(std::array<float, 4> m, AtPoints at, std::size_t count,
                                       Vec3Span normal) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 n = kernel::load(normal, i), dpdu = kernel::load(at.dpdu, i);
            const vec3 t = kernel::normalize(dpdu - n * kernel::dot(n, dpdu));
            const vec3 across = kernel::cross(n, t);
            const float side = kernel::dot(across, kernel::load(at.dpdv, i)) < 0 ? -1.0f : 1.0f;
            const vec3 mapped = 2.0f * kernel::load(at.texel, i) - vec3(1.0f);
            const float x = m[0] * mapped.x + m[1] * mapped.y, y = m[2] * mapped.x + m[3] * mapped.y;
            const vec3 tilted = x * t + y * (side * across) + mapped.z * n;
            kernel::store(normal, i, unit_or(tilted, n));
        }
    }
};

/// Blinn (1978), "Simulation of wrinkled surfaces"; with the surface's gradient as in Mikkelsen (2010), "Bump
/// mapping unparametrized surfaces on the GPU", equation 8.
struct BumpMapLoop {
    CANDELA_BATCH_LOOP static void run(std::array<float, 4> m, AtPoints at, std::size_t count,
                                       Vec3Span normal) {
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const vec3 n = kernel::load(normal, i), texel = kernel::load(at.texel, i);
            const float x = texel.x - k_level, y = texel.y - k_level;
            const float along_u = m[0] * x + m[1] * y, along_v = m[2] * x + m[3] * y;
            const vec3 dpdu = kernel::load(at.dpdu, i);
            const vec3 r1 = kernel::cross(kernel::load(at.dpdv, i), n), r2 = kernel::cross(n, dpdu);
            const float det = kernel::dot(dpdu, r1);
            const vec3 gradient = along_u * r1 + along_v * r2;
            const float side = det < 0 ? -1.0f : 1.0f;
            kernel::store(normal, i, unit_or(side * det * n - side * gradient, n));
        }
    }
};

/// In the layout of `heights`, whose red channel has the heights.
MipMap::Texels slopes_of(const DecodedTexels& heights, const std::array<TextureWrap, 2>& wraps) {
    const auto neighbor = [](int x, int size, TextureWrap wrap) {
        return wrap == TextureWrap::repeat ? (x + size) % size : std::clamp(x, 0, size - 1);
    };
    const auto height = [&](int x, int y) {
        const auto texel = static_cast<std::size_t>(neighbor(y, heights.height, wraps[1])) *
                               static_cast<std::size_t>(heights.width) +
                           static_cast<std::size_t>(neighbor(x, heights.width, wraps[0]));
        return static_cast<int>(heights.texels[3 * texel]);
    };
    constexpr int k_none = 32768, k_most = 65535;
    const auto slope = [=](int before, int after) {
        return static_cast<std::uint16_t>(std::clamp(k_none + (after - before) / 2, 0, k_most));
    };
    MipMap::Texels slopes = MipMap::room_for(heights.width, heights.height);
    constexpr std::size_t k_rows = 64;
    parallel_for(static_cast<std::size_t>(heights.height), k_rows, [&](std::size_t begin, std::size_t end) {
        std::size_t to = 3 * begin * static_cast<std::size_t>(heights.width);
        for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
            for (int x = 0; x < heights.width; ++x, to += 3) {
                slopes[to] = slope(height(x - 1, y), height(x + 1, y));
                slopes[to + 1] = slope(height(x, y + 1), height(x, y - 1));
            }
        }
    });
    return slopes;
}

}  // namespace

TextureImage read_bump_map(const std::filesystem::path& file, Registry& registry,
                           const std::array<TextureWrap, 2>& wraps) {
    const DecodedTexels heights = read_texels(file, registry, ColorEncoding::none);
    return {std::make_shared<const MipMap>(heights.width, heights.height, slopes_of(heights, wraps)),
            heights.was_clamped};
}

void tilt_normals(const SurfaceModels& surface, const SurfacePoints& points, const Vec3Span& normal) {
    const MaterialTextures& textures = surface.material_textures;
    if (!textures.normal) return;
    const auto* const channel = &points.parameters[textures.numbers.size()];
    const AtPoints at{.texel = {channel[0].data(), channel[1].data(), channel[2].data()},
                      .dpdu = points.dpdu.span(),
                      .dpdv = points.dpdv.span()};
    if (textures.normal->has_slopes)
        multiversion<BumpMapLoop>(textures.normal->to_uv, at, points.filled, normal);
    else
        multiversion<NormalMapLoop>(textures.normal->to_uv, at, points.filled, normal);
}

}  // namespace candela
