module;

#include "candela/kernel/kernel.h"
#include "candela/kernel/simd_dispatch.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <stdexcept>
#include <vector>

module candela.raster;

import :binning;
import candela.api;

namespace candela {

namespace {

constexpr std::size_t k_triangles_per_bin = 4096;
constexpr std::size_t k_vertices_per_task = 16384;
constexpr float k_moderate = 0x1p40f;

/// The bits of a magnitude, which, as integers, have the same order.
[[gnu::always_inline]] inline std::int32_t magnitude(float x) {
    return std::bit_cast<std::int32_t>(x) & 0x7fff'ffff;
}

/// Projects vertices to homogeneous and to fixed-point pixels. `*largest_bits`: the largest magnitude among
/// homogeneous pixels and, times the largest picture's size, distances.
struct ProjectLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, float near, int subpixel_bits, ConstVec3Span position,
                                       std::size_t count, ProjectedVertex* projected, ScreenVertex* screen,
                                       std::int32_t* largest_bits) {
        const Vec3 eye = camera.eye;
        const float scale = camera.pixels_per_unit;
        const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
        const float cx = 0.5f * width, cy = 0.5f * height;
        const auto one = static_cast<float>(1 << subpixel_bits);
        const bool perspective = camera.projection == Projection::perspective;
        constexpr float k_largest_image = 65536;
        std::int32_t largest = *largest_bits;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = position[i] - eye;
            const float distance = dot(camera.forward, d);
            const float w = perspective ? distance : 1.0f;
            const float x = scale * dot(camera.right, d) + cx * w;
            const float y = cy * w - scale * dot(camera.up, d);
            projected[i].x = x;
            projected[i].y = y;
            projected[i].w = w;
            projected[i].distance = distance;

            // Without && and ||: they are branches, and stores after a branch are not vectorised.
            const float ahead = perspective ? distance - near : distance;
            const float half_x = cx * w, half_y = cy * w;
            const std::uint32_t view = (ahead < 0 ? Outside::near : 0u) | (x < 0 ? Outside::left : 0u) |
                                       (x > width * w ? Outside::right : 0u) | (y < 0 ? Outside::top : 0u) |
                                       (y > height * w ? Outside::bottom : 0u);
            const bool is_near =
                (ahead >= 0) & (x >= -half_x) & (x <= 3 * half_x) & (y >= -half_y) & (y <= 3 * half_y);
            const float inverse = 1 / w;
            const float px = x * inverse, py = y * inverse;
            const float from_x = kernel::abs(px - cx), from_y = kernel::abs(py - cy);
            const bool is_somewhere = (from_x <= 1.01f * width) & (from_y <= 1.01f * height);
            screen[i].x = static_cast<std::int32_t>(kernel::round_to_even(is_somewhere ? px * one : 0.0f));
            screen[i].y = static_cast<std::int32_t>(kernel::round_to_even(is_somewhere ? py * one : 0.0f));
            screen[i].depth = perspective ? inverse : -distance;
            screen[i].outside =
                view | (is_near ? 0u : Outside::guard) | ((is_near & !is_somewhere) ? Outside::nowhere : 0u);

            const std::int32_t at_x = magnitude(x), at_y = magnitude(y);
            const std::int32_t far = magnitude(k_largest_image * distance);
            const std::int32_t xy = at_x > at_y ? at_x : at_y;
            const std::int32_t all = xy > far ? xy : far;
            largest = largest > all ? largest : all;
        }
        *largest_bits = largest;
    }
};

/// At most a tenth of a millimetre, and less if the whole scene is small. Anything nearer than a
/// hundred-thousandth of the farthest distance cannot be clipped accurately in floats.
float near_distance(std::span<const Mesh* const> meshes, const Camera& camera) {
    constexpr float k_most = 1e-4f, k_of_farthest = 1e-5f;
    float farthest = 0;
    for (const Mesh* mesh : meshes) {
        const Box& box = mesh->bounds;
        const Vec3& ahead = camera.forward;
        const Vec3 corner{ahead.x > 0 ? box.high.x : box.low.x, ahead.y > 0 ? box.high.y : box.low.y,
                          ahead.z > 0 ? box.high.z : box.low.z};
        farthest = std::max(farthest, dot(ahead, corner - camera.eye));
    }
    return farthest > 0 ? std::min(k_most, k_of_farthest * farthest) : k_most;
}

}  // namespace

ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                       int samples) {
    ProjectedScene scene;
    project(meshes, camera, tile_size, samples, scene);
    return scene;
}

void project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size, int samples,
             ProjectedScene& scene, std::optional<TileRows> rows) {
    scene.first_vertex.clear();
    scene.first_triangle.clear();
    scene.samples = samples;
    scene.camera = camera;
    scene.near = near_distance(meshes, camera);
    scene.tile_size = tile_size;
    scene.tile_columns = (camera.width + tile_size - 1) / tile_size;
    scene.tile_rows = (camera.height + tile_size - 1) / tile_size;
    scene.seen_rows = rows.value_or(TileRows{0, scene.tile_rows});
    // Twice the picture's size, in fixed point, must leave room for 64 steps in 32 bits.
    scene.subpixel_bits = std::max(camera.width, camera.height) <= 8192 ? 8 : 4;

    std::size_t vertices = 0;
    std::size_t triangles = 0;
    for (const Mesh* const mesh : meshes) {
        scene.first_vertex.push_back(static_cast<std::uint32_t>(vertices));
        scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
        vertices += mesh->vertex_count();
        triangles += mesh->triangle_count();
        if (vertices > k_no_triangle / 2 || triangles >= k_no_triangle) {
            throw std::length_error(
                "the scene has more than 4294967294 triangles, or more than half as many vertices");
        }
    }
    scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));

    scene.vertices.resize(vertices);
    scene.screen.resize(vertices);
    std::atomic<bool> is_moderate{true};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        parallel_for(meshes[m]->vertex_count(), k_vertices_per_task, [&](std::size_t begin, std::size_t end) {
            const std::size_t at = scene.first_vertex[m] + begin;
            std::int32_t largest = 0;
            std::int32_t* const largest_bits = &largest;
            multiversion<ProjectLoop>(camera, scene.near, scene.subpixel_bits,
                                      meshes[m]->position.span().from(begin), end - begin,
                                      &scene.vertices[at], &scene.screen[at], largest_bits);
            if (!(std::bit_cast<float>(largest) < k_moderate)) is_moderate = false;
        });
    }
    scene.is_moderate = is_moderate;

    // Ranges of the scene, not of its meshes: each tile looks at every bin.
    scene.bins.resize((triangles + k_triangles_per_bin - 1) / k_triangles_per_bin);
    parallel_for(scene.bins.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t bin = begin; bin < end; ++bin) {
            const std::size_t first = bin * k_triangles_per_bin;
            bin_triangles(scene, meshes, first, std::min(k_triangles_per_bin, triangles - first),
                          scene.bins[bin]);
        }
    });
}

}  // namespace candela
