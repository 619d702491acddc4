// From world space to fixed-point pixels.
module;

#include "candela/kernel.h"
#include "candela/multiversion.h"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

module candela.raster;

import candela.parallel;

namespace candela {

namespace {

constexpr std::size_t k_triangles_per_bin = 4096;
constexpr std::size_t k_vertices_per_task = 16384;
constexpr float k_moderate = 0x1p40f;

struct ProjectLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, ConstVec3Span position, std::size_t count, float* x,
                                       float* y, float* distance) {
        const Vec3 eye = camera.eye;
        const float scale = camera.pixels_per_unit;
        const float cx = 0.5f * static_cast<float>(camera.width);
        const float cy = 0.5f * static_cast<float>(camera.height);
        const bool perspective = camera.projection == Projection::perspective;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const Vec3 d = position[i] - eye;
            const float along = dot(camera.forward, d);
            const float w = perspective ? along : 1.0f;
            x[i] = scale * dot(camera.right, d) + cx * w;
            y[i] = cy * w - scale * dot(camera.up, d);
            distance[i] = along;
        }
    }
};

/// Vertices in homogeneous pixels to fixed-point ones.
struct ScreenLoop {
    CANDELA_BATCH_LOOP static void run(Camera camera, int subpixel_bits, std::size_t count, const float* x,
                                       const float* y, const float* distance, ScreenVertex* screen) {
        const auto width = static_cast<float>(camera.width), height = static_cast<float>(camera.height);
        const auto one = static_cast<float>(1 << subpixel_bits);
        const bool perspective = camera.projection == Projection::perspective;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const float w = perspective ? distance[i] : 1.0f;
            const float ahead = perspective ? distance[i] - k_near : distance[i];
            const float half_x = 0.5f * width * w, half_y = 0.5f * height * w;
            const std::uint32_t view = (ahead < 0 ? Outside::near : 0u) | (x[i] < 0 ? Outside::left : 0u) |
                                       (x[i] > width * w ? Outside::right : 0u) |
                                       (y[i] < 0 ? Outside::top : 0u) |
                                       (y[i] > height * w ? Outside::bottom : 0u);
            const bool is_near =
                ahead >= 0 && x[i] >= -half_x && x[i] <= 3 * half_x && y[i] >= -half_y && y[i] <= 3 * half_y;
            const float inverse = 1 / w;
            const float px = x[i] * inverse, py = y[i] * inverse;
            const float from_x = kernel::abs(px - 0.5f * width), from_y = kernel::abs(py - 0.5f * height);
            const bool is_somewhere = from_x <= 1.01f * width && from_y <= 1.01f * height;
            screen[i].x = static_cast<std::int32_t>(kernel::round_to_even(is_somewhere ? px * one : 0.0f));
            screen[i].y = static_cast<std::int32_t>(kernel::round_to_even(is_somewhere ? py * one : 0.0f));
            screen[i].closeness = perspective ? inverse : -distance[i];
            screen[i].outside =
                view | (is_near ? 0u : Outside::guard) | (is_near && !is_somewhere ? Outside::nowhere : 0u);
        }
    }
};

/// The largest magnitude among homogeneous pixels and, times the largest picture's size, w. As integers,
/// which without a sign are in the same order as the floats of their bits.
struct MagnitudeLoop {
    CANDELA_BATCH_LOOP static void run(std::size_t count, const float* x, const float* y,
                                       const float* distance, std::int32_t* bits) {
        constexpr std::int32_t k_magnitude = 0x7fff'ffff;
        constexpr float k_largest_picture = 65536;
        std::int32_t largest = *bits;
        CANDELA_VECTORIZE
        for (std::size_t i = 0; i < count; ++i) {
            const std::int32_t at_x = std::bit_cast<std::int32_t>(x[i]) & k_magnitude;
            const std::int32_t at_y = std::bit_cast<std::int32_t>(y[i]) & k_magnitude;
            const std::int32_t w = std::bit_cast<std::int32_t>(k_largest_picture * distance[i]) & k_magnitude;
            const std::int32_t xy = at_x > at_y ? at_x : at_y;
            const std::int32_t xyw = xy > w ? xy : w;
            largest = largest > xyw ? largest : xyw;
        }
        *bits = largest;
    }
};

struct Stretch {
    std::size_t mesh;
    std::size_t first;  // triangle of the mesh
    std::size_t count;
};

}  // namespace

ProjectedScene project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size,
                       int samples) {
    ProjectedScene scene;
    project(meshes, camera, tile_size, samples, scene);
    return scene;
}

void project(std::span<const Mesh* const> meshes, const Camera& camera, int tile_size, int samples,
             ProjectedScene& scene) {
    scene.first_vertex.clear();
    scene.first_triangle.clear();
    scene.samples = samples;
    scene.camera = camera;
    scene.tile_size = tile_size;
    scene.tile_columns = (camera.width + tile_size - 1) / tile_size;
    scene.tile_rows = (camera.height + tile_size - 1) / tile_size;
    // Twice the picture's size, in fixed point, must leave room for 64 steps in 32 bits.
    scene.subpixel_bits = std::max(camera.width, camera.height) <= 8192 ? 8 : 4;

    std::size_t vertices = 0;
    std::size_t triangles = 0;
    std::vector<Stretch> stretches;
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        scene.first_vertex.push_back(static_cast<std::uint32_t>(vertices));
        scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));
        vertices += meshes[m]->vertex_count();
        triangles += meshes[m]->triangle_count();
        if (vertices > k_no_triangle / 2 || triangles >= k_no_triangle) {
            throw std::length_error("the scene has more than 4294967294 triangles, or half as many vertices");
        }
        for (std::size_t first = 0; first < meshes[m]->triangle_count(); first += k_triangles_per_bin) {
            stretches.push_back(
                {m, first, std::min(k_triangles_per_bin, meshes[m]->triangle_count() - first)});
        }
    }
    scene.first_triangle.push_back(static_cast<std::uint32_t>(triangles));

    scene.x.resize(vertices);
    scene.y.resize(vertices);
    scene.distance.resize(vertices);
    scene.screen.resize(vertices);
    std::atomic<bool> is_moderate{true};
    for (std::size_t m = 0; m < meshes.size(); ++m) {
        parallel_for(meshes[m]->vertex_count(), k_vertices_per_task, [&](std::size_t begin, std::size_t end) {
            const std::size_t at = scene.first_vertex[m] + begin;
            float* const x = &scene.x[at];
            float* const y = &scene.y[at];
            float* const distance = &scene.distance[at];
            multiversion<ProjectLoop>(camera, meshes[m]->position.span().from(begin), end - begin, x, y,
                                      distance);
            multiversion<ScreenLoop>(camera, scene.subpixel_bits, end - begin, x, y, distance,
                                     &scene.screen[at]);
            std::int32_t largest = 0;
            std::int32_t* const bits = &largest;
            multiversion<MagnitudeLoop>(end - begin, x, y, distance, bits);
            if (!(std::bit_cast<float>(largest) < k_moderate)) is_moderate = false;
        });
    }
    scene.is_moderate = is_moderate;

    scene.bins.resize(stretches.size());
    parallel_for(stretches.size(), 1, [&](std::size_t begin, std::size_t end) {
        for (std::size_t s = begin; s < end; ++s) {
            const auto [m, first, count] = stretches[s];
            bin_triangles(scene, *meshes[m], scene.first_vertex[m], scene.first_triangle[m], first, count,
                          scene.bins[s]);
        }
    });
}

}  // namespace candela
