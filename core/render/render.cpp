// One picture.
module;

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <stdexcept>
#include <vector>

module candela.render;

import candela.diagnostics;
import candela.film;
import candela.mesh;
import candela.parallel;
import candela.raster;
import candela.scene;

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// All samples of a tile's visibility should fit the second-level cache.
int tile_size_for(int samples) { return samples <= 4 ? 64 : 32; }

}  // namespace

Camera camera_of(const Observer& observer, int width, int height) {
    const bool perspective = observer.projection == Projection::perspective;
    return Camera::looking(observer.position, observer.look_at, observer.up, observer.projection,
                           perspective ? observer.fov : observer.height, width, height);
}

RenderStatistics render(const CompiledScene& scene, Film& film, const RenderOptions& options) {
    RenderStatistics statistics;
    std::atomic<std::size_t> tiles_done{0}, pixels_shaded{0}, points_lit{0};
    std::atomic<float> brightest{0};
    const int tile_size = options.tile_size > 0 ? options.tile_size : tile_size_for(scene.image.samples);
    std::vector<const Mesh*> meshes;
    for (const SolidObject& object : scene.objects) meshes.push_back(&object.mesh);

    with_threads(options.threads, [&] {
        const auto begin = Clock::now();
        const Camera camera = camera_of(scene.observer, film.width(), film.height());
        ProjectedScene projected;
        try {
            projected = project(meshes, camera, tile_size);
        } catch (const std::length_error& problem) {
            throw Error(ExitCode::failure, problem.what());
        }
        statistics.seconds_projecting = seconds_since(begin);
        statistics.triangles = projected.first_triangle.back();

        const auto tiles_begin = Clock::now();
        const auto tiles = static_cast<std::size_t>(projected.tile_count());
        // A few tiles at a time, so that a shader's arrays are made seldom and the threads still end
        // together.
        const std::size_t grain = std::clamp<std::size_t>(tiles / 64, 1, 16);
        parallel_for(tiles, grain, [&](std::size_t first, std::size_t last) {
            TileShader shader(scene, projected);
            for (std::size_t tile = first; tile < last; ++tile) {
                shader.run(static_cast<int>(tile), film);
                const std::size_t done = ++tiles_done;
                if (options.progress) options.progress(done, tiles);
            }
            pixels_shaded += shader.pixels_shaded();
            points_lit += shader.points_lit();
            float before = brightest;
            while (before < shader.brightest() &&
                   !brightest.compare_exchange_weak(before, shader.brightest())) {
            }
        });
        statistics.seconds_on_tiles = seconds_since(tiles_begin);
    });
    statistics.pixels_shaded = pixels_shaded;
    statistics.points_lit = points_lit;
    statistics.brightest = brightest;
    return statistics;
}

}  // namespace candela
