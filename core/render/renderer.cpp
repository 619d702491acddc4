// State kept from picture to picture, threads, and statistics; the stages are in pipeline.cpp.
module;

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <utility>
#include <vector>

module candela.render;

import :tile;
import candela.api;
import candela.geometry;
import candela.raster;
import candela.scene;
import candela.shading;
import candela.util;

namespace candela {

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
    return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// All samples of a tile's visibility should fit into the second-level cache.
int tile_size_for(int samples) { return samples <= 4 ? 64 : 32; }

/// The parts of a scene that visibility depends on.
struct SeenScene {
    SeenScene(const RenderScene& scene, const Film& film, const RenderOptions& options)
        : observer(scene.observer),
          width(film.width()),
          height(film.height()),
          rows(film.rows()),
          samples(is_geometric(options.term) ? 1 : scene.image.samples),
          tile_size(options.tile_size > 0 ? options.tile_size : tile_size_for(samples)) {
        for (const RenderObject& object : scene.objects)
            meshes.push_back(
                {object.mesh.position.x.data(), object.mesh.indices.data(), object.mesh.indices.size()});
    }

    struct MeshPlace {
        const float* position;
        const std::uint32_t* indices;
        std::size_t corner_count;
        friend bool operator==(const MeshPlace&, const MeshPlace&) = default;
    };

    Observer observer;
    int width, height;
    RowRange rows;
    int samples, tile_size;
    std::vector<MeshPlace> meshes;

    friend bool operator==(const SeenScene&, const SeenScene&) = default;
};

/// An estimate of the time that one thread takes to shade a whole picture, from the times per point and
/// light, and per triangle, on processors of 2020.
double rough_milliseconds(const RenderScene& scene, const Film& film) {
    double triangles = 0;
    for (const RenderObject& object : scene.objects)
        triangles += static_cast<double>(object.mesh.triangle_count());
    const double points = 1.0 * film.width() * film.rows().count() * scene.image.samples;
    return 5e-6 * points * static_cast<double>(std::max<std::size_t>(scene.lights.size(), 1)) +
           2e-5 * triangles;
}
/// A sequence of pictures is worth more threads, however small each is.
constexpr double k_again_and_again = std::numeric_limits<double>::infinity();

}  // namespace

struct Renderer::Kept {
    explicit Kept(Keep keep) : what(keep) {}

    Keep what;
    ProjectedScene projected;
    Pool<TileWorker> workers;
    std::vector<VisibleTile> tiles;  // if visibility is kept
    std::optional<SeenScene> seen;   // what the complete tiles show
    bool is_first = true;            // whether this is the first picture

    /// Runs the stages from projection on, or from shading on if `is_seen`.
    RenderStatistics render(const RenderScene& scene, Film& film, const RenderOptions& options,
                            const SeenScene& to_see, bool is_seen) {
        RenderStatistics statistics;
        const auto begin = Clock::now();
        if (!is_seen)
            project_scene(scene, to_see.width, to_see.height, to_see.rows, to_see.tile_size, to_see.samples,
                          projected);
        const auto tile_count = static_cast<std::size_t>(projected.seen_tile_count());
        if (what == Keep::visibility) tiles.resize(tile_count);
        statistics.seconds_projecting = seconds_since(begin);
        statistics.triangles = projected.first_triangle.back();

        const auto tiles_begin = Clock::now();
        const auto begin_image = [&](TileWorker& worker) {
            worker.shader.begin(scene, projected, options.term, options.light, options.parameter);
            worker.pixels_shaded = 0;
        };
        workers.each(begin_image);
        const auto make = [&] {
            auto worker = std::make_unique<TileWorker>();
            begin_image(*worker);
            return worker;
        };
        std::vector<std::uint8_t> is_done(tile_count);
        if (const auto background = uniform_background(scene, options.term, options.light)) {
            const auto columns = static_cast<std::size_t>(projected.tile_columns);
            parallel_for(tile_count / columns, 1, [&](std::size_t first, std::size_t last) {
                for (std::size_t row = first; row < last; ++row)
                    fill_empty_tiles(projected, projected.seen_rows.first + static_cast<int>(row),
                                     *background, film, std::span(is_done).subspan(row * columns, columns));
            });
        }
        std::atomic<std::size_t> tiles_done{0};
        const std::size_t grain = std::clamp<std::size_t>(tile_count / 64, 1, 4);
        parallel_for(tile_count, grain, [&](std::size_t first, std::size_t last) {
            workers.with(make, [&](TileWorker& worker) {
                for (std::size_t tile = first; tile < last; ++tile) {
                    if (is_done[tile] == 0) {
                        VisibleTile& visible = what == Keep::visibility ? tiles[tile] : worker.visible;
                        if (!is_seen)
                            find_visible(projected, projected.first_seen_tile() + static_cast<int>(tile),
                                         worker.visibility, visible);
                        shade_tile(scene, visible, worker, film);
                    }
                    if (options.progress) options.progress(++tiles_done, tile_count);
                }
            });
        });
        workers.each([&](const TileWorker& worker) {
            statistics.pixels_shaded += worker.pixels_shaded;
            statistics.points_lit += worker.shader.points_lit();
            statistics.brightest = std::max(statistics.brightest, worker.shader.brightest());
        });
        statistics.seconds_on_tiles = seconds_since(tiles_begin);
        return statistics;
    }
};

DisplayTransform display_of(const RenderScene& scene) {
    return {scene.image.color_management, exposure_factor(scene.observer.exposure), scene.image.tone};
}

Renderer::Renderer(Keep keep) : kept_(std::make_unique<Kept>(keep)) {}
Renderer::Renderer(Renderer&&) noexcept = default;
Renderer& Renderer::operator=(Renderer&&) noexcept = default;
Renderer::~Renderer() = default;

void Renderer::forget() noexcept { kept_->seen.reset(); }

RenderStatistics Renderer::render(const RenderScene& scene, Film& film, const RenderOptions& options) {
    SeenScene to_see(scene, film, options);
    const bool is_seen = kept_->what == Keep::visibility && kept_->seen == to_see;
    // Until they are complete, the tiles count as empty: something may throw.
    if (!is_seen) kept_->seen.reset();
    RenderStatistics statistics;
    with_threads(
        options.threads, [&] { statistics = kept_->render(scene, film, options, to_see, is_seen); },
        std::exchange(kept_->is_first, false) ? rough_milliseconds(scene, film) : k_again_and_again);
    if (!is_seen) kept_->seen = std::move(to_see);
    return statistics;
}

RenderStatistics render(const RenderScene& scene, Film& film, const RenderOptions& options) {
    return Renderer().render(scene, film, options);
}

}  // namespace candela
